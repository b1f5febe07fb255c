#include "inslab/models/navigation/rest_detector.hpp"

#include "inslab/foundation/units/units.hpp"

namespace inslab::navigation {

namespace {

double largest_spread(const Vector3& sum, const Vector3& squares, double count) {
  const Vector3 variance = squares / count - (sum / count).cwiseAbs2();
  return std::sqrt(std::max(0.0, variance.maxCoeff()));
}

}  // namespace

bool RestDetector::add(const Vector3& omega_ib_b, const Vector3& f_b, double dt_s) {
  if (count_ == 0.0) {
    omega_first_ = omega_ib_b;
    f_first_ = f_b;
  }
  count_ += 1.0;
  window_s_ += dt_s;
  const Vector3 omega = omega_ib_b - omega_first_, f = f_b - f_first_;
  omega_sum_ += omega;
  f_sum_ += f;
  omega_squares_ += omega.cwiseAbs2();
  f_squares_ += f.cwiseAbs2();
  if (window_s_ < thresholds_.window_s - 0.5 * dt_s) return false;
  const Vector3 mean_rate = omega_first_ + omega_sum_ / count_;
  const bool rest =
      largest_spread(f_sum_, f_squares_, count_) <= thresholds_.force_spread_m_per_s2 &&
      largest_spread(omega_sum_, omega_squares_, count_) <= units::kDegPerS * thresholds_.rate_spread_deg_per_s &&
      mean_rate.cwiseAbs().maxCoeff() <= units::kDegPerS * thresholds_.mean_rate_deg_per_s;
  restart();
  return rest;
}

}  // namespace inslab::navigation
