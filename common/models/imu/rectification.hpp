#pragma once

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// Stage 4a, too: an accelerometer turns vibration along its axis into a bias, K <(f - mean)^2> (vibration
/// rectification, VRE of IEEE Std 1293). The mean square is that of the vibration within the interval
/// (Vibration::moments); what the square makes of the interval's mean is in Nonlinearity. Of an accelerometer that is a
/// square and nothing else, 1 ppm/g there is 0.980665 mGal/g^2 here.
class Rectification {
 public:
  explicit Rectification(const Vector3& mgal_per_g2)
      : coefficient_(mgal_per_g2 * (units::kMGal / kG2)), is_off_(coefficient_.isZero(0.0)) {}

  bool is_off() const { return is_off_; }

  /// The error of an interval, m/s, from its `moments`, (m/s^2)^2.
  Vector3 error(const Matrix3& moments, double dt_s) const {
    return dt_s * coefficient_.cwiseProduct(moments.diagonal());
  }

 private:
  static constexpr double kG2 = units::kG * units::kG;

  Vector3 coefficient_;  ///< m/s^2 per (m/s^2)^2
  bool is_off_;
};

}  // namespace inslab::imu
