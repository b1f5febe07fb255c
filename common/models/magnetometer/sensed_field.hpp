#pragma once

#include <optional>
#include <vector>

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/profiles/magnetometer_error_profile.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/course.hpp"
#include "inslab/models/magnetometer/earth_field.hpp"

namespace inslab::magnetometer {

/// The field at a magnetometer's place along its axes, before anything on board acts on it: that of the Earth at
/// the run's date, and of bodies beside the way.
class SensedField {
 public:
  void use(const InstallationProfile& installation);
  void use(const std::vector<MagneticBody>& bodies) { bodies_ = bodies; }

  /// nT, at `truth`'s time; the date is that of sim time 0.
  Vector3 B_b_nt(const TruthState& truth);

 private:
  std::optional<EarthField> earth_;  ///< once a truth sample has said which date it is
  std::vector<MagneticBody> bodies_;
  Vector3 lever_arm_v_m_ = Vector3::Zero();
  Matrix3 C_bv_ = Matrix3::Identity();
};

/// (I + soft iron) of a profile, and the field of its currents over time, nT.
Matrix3 response(const MagnetometerErrorProfile& profile);
time::Course<Vector3> currents_nt(const MagnetometerErrorProfile& profile);

}  // namespace inslab::magnetometer
