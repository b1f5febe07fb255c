#pragma once

#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// Tells rest from motion by what the IMU alone feels: in windows one after the other, every axis of the specific force
/// and of the rate must spread less, and the mean rate be less, than the stated thresholds. A smooth cruise passes too:
/// InertialFilter looks at the speed besides.
class RestDetector {
 public:
  explicit RestDetector(const ZeroVelocity& thresholds) : thresholds_(thresholds) {}

  /// Takes a valid sample, rad/s and m/s^2; true when it ends a window of rest.
  bool add(const Vector3& omega_ib_b, const Vector3& f_b, double dt_s);

  /// Whether the next sample is the first of a window.
  bool is_new() const { return count_ == 0.0; }

  /// Begins a new window: a sample was not valid or is missing.
  void restart() { *this = RestDetector(thresholds_); }

 private:
  ZeroVelocity thresholds_;
  double window_s_ = 0.0;
  double count_ = 0.0;
  Vector3 omega_first_ = Vector3::Zero();  ///< sums are of differences from the first, or gravity would swamp them
  Vector3 f_first_ = Vector3::Zero();
  Vector3 omega_sum_ = Vector3::Zero();
  Vector3 f_sum_ = Vector3::Zero();
  Vector3 omega_squares_ = Vector3::Zero();
  Vector3 f_squares_ = Vector3::Zero();
};

}  // namespace inslab::navigation
