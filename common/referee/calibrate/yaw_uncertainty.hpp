#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inslab/referee/calibrate/tilt_trend.hpp"

namespace inslab::calibrate {

/// Yaw's standard deviation past which an alignment is no heading to start from.
inline constexpr double kYawWarningDeg = 5.0;

/// How well yaw is known that the Earth's rate gave, and why.
struct YawUncertainty {
  double sigma_rad = 0.0;             ///< at most that of a yaw of which nothing is known, pi / sqrt(3)
  double bias_rad_per_s = 0.0;        ///< standard deviation of the gyros' bias that was counted with
  double shown_bias_rad_per_s = 0.0;  ///< root mean square of the two figures of it that a recording shows
  bool bias_is_given = false;         ///< or the one that shows
  double noise_rad_per_s = 0.0;       ///< of the mean rate about east; 0 for fewer than three seconds
  double horizontal_rad_per_s = 0.0;  ///< the Earth's rate times cos(latitude)
};

/// `omega_ie_b`: what yaw was found from; `trend`: that was taken out. The bias is as given (rad/s), or what shows: the
/// rate along gravity and the horizontal rate's length are known at a latitude. When more than three times the given
/// one shows, which chance does once in 8000 recordings, that counts.
YawUncertainty yaw_uncertainty(const nav::Vector3& omega_ie_b, const nav::Vector3& down_b, double latitude_rad,
                               const std::vector<SecondMeans>& seconds, const std::optional<TiltTrend>& trend,
                               const std::optional<double>& given_bias_rad_per_s);

/// The bias that makes yaw's standard deviation this large, rad/s.
double bias_for_yaw_rad_per_s(double yaw_sigma_rad, double latitude_rad);

/// The coarsest grade of the thesis's table 2-2 whose gyros do for a bias: "intermediate grade (0.1 deg/h)".
std::string grade_for_bias(double bias_rad_per_s);

}  // namespace inslab::calibrate
