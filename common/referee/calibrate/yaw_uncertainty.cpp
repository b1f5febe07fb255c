#include "inslab/referee/calibrate/yaw_uncertainty.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::calibrate {
namespace {

using nav::wgs84::omega_e_rad_per_s;

/// Variance of the mean rate about east from the differences of neighbours, which a constant bias leaves alone.
double noise_variance(const nav::Vector3& east_b, const std::vector<SecondMeans>& seconds) {
  if (seconds.size() < 3) return 0.0;
  double squares = 0.0;
  for (std::size_t k = 1; k < seconds.size(); ++k) {
    const double difference = east_b.dot(seconds[k].omega_ib_b - seconds[k - 1].omega_ib_b);
    squares += difference * difference;
  }
  return squares / (2.0 * static_cast<double>(seconds.size() - 1)) / static_cast<double>(seconds.size());
}

struct Grade {
  const char* text;
  double bias_deg_per_h;
};
constexpr std::array<Grade, 5> kGrades{{{"automotive grade (100 deg/h)", 100.0},
                                        {"tactical grade at its best (1 deg/h)", 1.0},
                                        {"intermediate grade (0.1 deg/h)", 0.1},
                                        {"aviation grade (0.01 deg/h)", 0.01},
                                        {"marine grade (0.001 deg/h)", 0.001}}};

}  // namespace

YawUncertainty yaw_uncertainty(const nav::Vector3& omega_ie_b, const nav::Vector3& down_b, double latitude_rad,
                               const std::vector<SecondMeans>& seconds, const std::optional<TiltTrend>& trend,
                               const std::optional<double>& given_bias_rad_per_s) {
  constexpr double kFarOff = 3.0;
  YawUncertainty yaw;
  yaw.horizontal_rad_per_s = omega_e_rad_per_s * std::cos(latitude_rad);
  const double down_rad_per_s = omega_ie_b.dot(down_b);
  const nav::Vector3 horizontal_b = omega_ie_b - down_rad_per_s * down_b;
  const double along_down = down_rad_per_s + omega_e_rad_per_s * std::sin(latitude_rad);
  const double along_north = horizontal_b.norm() - yaw.horizontal_rad_per_s;
  yaw.shown_bias_rad_per_s = std::hypot(along_down, along_north) / std::sqrt(2.0);
  yaw.bias_is_given = given_bias_rad_per_s && yaw.shown_bias_rad_per_s <= kFarOff * *given_bias_rad_per_s;
  yaw.bias_rad_per_s = yaw.bias_is_given ? *given_bias_rad_per_s : yaw.shown_bias_rad_per_s;

  const nav::Vector3 east_b = down_b.cross(omega_ie_b).normalized();
  double variance = noise_variance(east_b, seconds);
  // The slope of a random walk has 6/5 of the variance of its end's, and the tilt's own comes to it.
  if (trend) variance = 1.2 * variance + trend->sigma_rad_per_s * trend->sigma_rad_per_s;
  yaw.noise_rad_per_s = std::sqrt(variance);
  yaw.sigma_rad = std::min(std::hypot(yaw.bias_rad_per_s, yaw.noise_rad_per_s) / yaw.horizontal_rad_per_s,
                           units::kPi / std::sqrt(3.0));
  return yaw;
}

double bias_for_yaw_rad_per_s(double yaw_sigma_rad, double latitude_rad) {
  return yaw_sigma_rad * omega_e_rad_per_s * std::cos(latitude_rad);
}

std::string grade_for_bias(double bias_rad_per_s) {
  for (const Grade& grade : kGrades) {
    if (grade.bias_deg_per_h * units::kDegPerH <= bias_rad_per_s) return grade.text;
  }
  return "better than marine grade (0.001 deg/h)";
}

}  // namespace inslab::calibrate
