#pragma once

#include "nav/strapdown.hpp"
#include "samples/imu_truth.hpp"
#include "samples/truth_state.hpp"

/// The true navigation state that a sample holds.
namespace inslab {

/// Of the vehicle's reference point and axes.
inline nav::NavState nav_state(const TruthState& truth) {
  return {{truth.latitude_rad, truth.longitude_rad, truth.height_m}, truth.v_n, truth.q_nv};
}

/// Of the IMU's centre and axes.
inline nav::NavState nav_state(const ImuTruth& truth) {
  return {{truth.latitude_rad, truth.longitude_rad, truth.height_m}, truth.v_n, truth.q_nb};
}

}  // namespace inslab
