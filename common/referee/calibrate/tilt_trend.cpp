#include "inslab/referee/calibrate/tilt_trend.hpp"

#include <cmath>

namespace inslab::calibrate {
namespace {

constexpr std::size_t kFewestSeconds = 10;

}  // namespace

std::optional<TiltTrend> tilt_trend(const std::vector<SecondMeans>& seconds, double second_s) {
  if (seconds.size() < kFewestSeconds) return std::nullopt;
  const double n = static_cast<double>(seconds.size());
  nav::Vector3 f_sum = nav::Vector3::Zero(), rate_sum = nav::Vector3::Zero();
  for (const SecondMeans& second : seconds) {
    f_sum += second.f_b;
    rate_sum += second.omega_ib_b;
  }
  const nav::Vector3 down_b = -f_sum.normalized();

  // d(down_b)/dt = down_b x omega_nb_b, so that the tilt since the mean is down_b(t) x down_b. Times from the middle:
  // the sum of (t - mean)^2 over n seconds is n (n^2 - 1) / 12.
  nav::Vector3 angle = nav::Vector3::Zero(), of_tilt = nav::Vector3::Zero(), of_angle = nav::Vector3::Zero(), before;
  double differences = 0.0;
  for (std::size_t k = 0; k < seconds.size(); ++k) {
    const double from_middle_s = second_s * (static_cast<double>(k) - 0.5 * (n - 1.0));
    const nav::Vector3 tilt = -seconds[k].f_b.normalized().cross(down_b);
    of_tilt += from_middle_s * tilt;
    of_angle += from_middle_s * (angle + 0.5 * second_s * seconds[k].omega_ib_b);
    angle += second_s * seconds[k].omega_ib_b;
    if (k > 0) differences += (tilt - before).squaredNorm();
    before = tilt;
  }
  const double times = second_s * second_s * n * (n * n - 1.0) / 12.0;
  // Two axes, and a difference has twice the variance of a second.
  const double variance_of_second = differences / (4.0 * (n - 1.0));
  TiltTrend trend;
  trend.omega_nb_b = of_tilt / times;
  trend.sigma_rad_per_s = std::sqrt(variance_of_second / times);
  const nav::Vector3 difference = (of_angle - of_tilt) / times;
  trend.omega_ie_b = difference + down_b.dot(rate_sum / n - difference) * down_b;
  return trend;
}

}  // namespace inslab::calibrate
