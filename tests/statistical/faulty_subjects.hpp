#pragma once

#include "inslab/referee/verify/subjects.hpp"

/// The product's subjects with a fault in each.
namespace inslab::verify {

/// Changes a sample of the truth as it comes out.
using Distortion = std::function<void(TruthState& truth)>;
TruthOf truth_with(const Distortion& distortion);
InverseOf inverse_with(const Distortion& distortion);

/// An IMU that is set up otherwise than it is told, or whose output is changed on its way.
ImuOf imu_set_up_with(const std::function<void(imu::ImuModel::Setup& setup)>& change);
ImuOf imu_with(const std::function<void(imu::ImuModel::Output& output)>& change);
/// Whose output comes late by this part of a sample: as much of it is still that of the interval before.
ImuOf late_imu(double part_of_a_sample);

/// A mechanization that is given other increments than those of the IMU. `change` is told the state that they begin at,
/// and the increments before.
using IncrementsChange =
    std::function<void(nav::ImuIncrements& imu, const nav::NavState& state, const nav::ImuIncrements& before)>;
MechanizationOf mechanization_with(const IncrementsChange& change);

/// What a term of the wrong size adds to dv, m/s in b: so an algorithm with that term is the sound one with this.
nav::Vector3 coriolis_of_wrong_sign_b(const nav::NavState& state, double dt_s);

/// A run of other sensors than those that are asked for, or whose samples are changed on their way.
Simulation simulation_of(const std::function<void(scenario::LoadedScenario& scenario)>& change);
Simulation simulation_with_fixes(const std::function<void(GnssFix& fix)>& change,
                                 const Simulation& sensors = product_simulation);

}  // namespace inslab::verify
