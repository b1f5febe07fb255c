#pragma once

#include <cmath>
#include <string>

#include "inslab/referee/evidence/noise_statistics.hpp"
#include "inslab/referee/evidence/swap_evidence.hpp"

/// How single figures of a swap are judged, whichever sensor they are of.
namespace inslab::evidence {

inline const Vector3 kAllAxes(1.0, 1.0, 1.0);
inline const Vector3 kHorizontal(1.0, 1.0, 0.0);
inline const Vector3 kVertical(0.0, 0.0, 1.0);

inline Measured judged(double value, double promised, double tolerance) {
  return {value, promised, tolerance, std::abs(value - promised) <= tolerance};
}

/// Values of which so many tell as much as one independent one. First differences of white noise overlap: 1.5.
inline constexpr double kWhiteDifferences = 1.5;

/// Standard deviation from n independent values has the relative standard error sqrt(1/(2n)).
inline double sigma_tolerance(double promised, double values, double per_independent = 1.0) {
  return 4.0 * promised * std::sqrt(per_independent / (2.0 * values));
}

inline double mean_square(const Vector3& v, const Vector3& mask) { return v.cwiseProduct(v).dot(mask) / mask.sum(); }

/// One line for the noise of fixes, from first differences: of a Gauss-Markov error, which is slow, they pass the power
/// 1 - exp(-dt/T).
inline EvidenceLine fix_line(const char* quantity, const char* unit, const NoiseStatistics& before,
                             const NoiseStatistics& after, double promised_before, double promised_after,
                             const Vector3& mask) {
  const auto measured = [&](const NoiseStatistics& series, double promised) {
    return judged(series.pooled_white_sigma(mask), promised,
                  sigma_tolerance(promised, mask.sum() * static_cast<double>(series.differences()), kWhiteDifferences));
  };
  return {quantity, unit, measured(before, promised_before), measured(after, promised_after)};
}

/// What fix_line() should find for a white and a Gauss-Markov error, pooled over the axes of `mask`.
inline double promised_difference_sigma(const Vector3& white, const Vector3& gm_sigma,
                                        const Vector3& correlation_time_s, double dt_s, const Vector3& mask) {
  Vector3 passed = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (gm_sigma[axis] > 0.0) passed[axis] = gm_sigma[axis] * std::sqrt(-std::expm1(-dt_s / correlation_time_s[axis]));
  }
  return std::sqrt(mean_square(white, mask) + mean_square(passed, mask));
}

}  // namespace inslab::evidence
