#pragma once

#include "inslab/data/samples/airflow_truth.hpp"
#include "inslab/data/samples/imu_truth.hpp"

namespace inslab::faults {

/// Enters into the truth beside a sample what faults did to it: `before` is the sample without them.
inline void enter(ImuTruth& truth, const ImuSample& before, const ImuSample& after, std::uint32_t active) {
  truth.gyro_error.fault = after.dtheta_b - before.dtheta_b;
  truth.accel_error.fault = after.dv_b - before.dv_b;
  truth.active_faults = active;
}

inline void enter(AirflowTruth& truth, const Airflow& before, const Airflow& after, std::uint32_t active) {
  truth.impact_pressure_error.fault = after.impact_pressure_pa - before.impact_pressure_pa;
  truth.static_pressure_error.fault = after.static_pressure_pa - before.static_pressure_pa;
  truth.angle_of_attack_error.fault = after.angle_of_attack_rad - before.angle_of_attack_rad;
  truth.angle_of_sideslip_error.fault = after.angle_of_sideslip_rad - before.angle_of_sideslip_rad;
  truth.active_faults = active;
}

/// A sample that says that it is not valid and shows nothing, of a sensor whose every sample is answered; false where
/// samples of the kind cannot say so, and are left out.
template <class Sample>
bool made_not_valid(Sample&) {
  return false;
}
inline bool made_not_valid(ImuSample& sample) {
  sample.dtheta_b.setZero();
  sample.dv_b.setZero();
  sample.mean_omega_ib_b.setZero();
  sample.mean_f_b.setZero();
  sample.gyro_valid = sample.accel_valid = false;
  sample.gyro_saturated = sample.accel_saturated = false;
  return true;
}

/// What a sample shows that was not valid before stays as it was.
template <class Sample>
void keep_not_valid(Sample&, const Sample&) {}
inline void keep_not_valid(ImuSample& sample, const ImuSample& before) {
  if (!before.gyro_valid) {
    sample.dtheta_b = before.dtheta_b;
    sample.mean_omega_ib_b = before.mean_omega_ib_b;
  }
  if (!before.accel_valid) {
    sample.dv_b = before.dv_b;
    sample.mean_f_b = before.mean_f_b;
  }
}

}  // namespace inslab::faults
