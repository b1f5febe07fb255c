#pragma once

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/nav/strapdown.hpp"

/// The true navigation state that a sample holds.
namespace inslab {

/// Of the vehicle's reference point and axes.
inline nav::NavState nav_state(const TruthState& truth) { return {geodetic_of(truth), truth.v_n, truth.q_nv}; }

/// Of the IMU's centre and axes.
inline nav::NavState nav_state(const ImuTruth& truth) { return {geodetic_of(truth), truth.v_n, truth.q_nb}; }

}  // namespace inslab
