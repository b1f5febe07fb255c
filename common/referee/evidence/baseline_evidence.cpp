#include "inslab/referee/evidence/baseline_evidence.hpp"

#include <cmath>

#include "inslab/referee/evidence/arm_evidence.hpp"

namespace inslab::evidence {

std::vector<EvidenceLine> baseline_lines(const LogSummary& summary, const SwapWindows& swap) {
  const auto measured = [&](const SwapWindow& window) {
    const auto arms = profile_in_use<InstallationProfile>(summary, swap.ack.target, window.after_ns + 1);
    const auto errors = profile_in_use<HeadingErrorProfile>(summary, swap.ack.target, window.after_ns + 1);
    // White noise averages out over the samples of a window; a Gauss-Markov error as slow as the window does not.
    const double error_m =
        std::hypot(errors.relative_sigma_ned_m.maxCoeff() / std::sqrt(static_cast<double>(window.baseline_v_m.count())),
                   errors.relative_gm_sigma_ned_m.maxCoeff());
    return MeasuredArm{window.baseline_v_m, arms.second_lever_arm_v_m - arms.lever_arm_v_m, error_m};
  };
  return arm_lines("baseline", measured(swap.before), measured(swap.after));
}

std::vector<EvidenceLine> baseline_noise_lines(const LogSummary& summary, const SwapWindows& swap, double period_s) {
  const auto line = [&](const char* name, const Vector3& mask) {
    const auto promised = [&](const SwapWindow& window) {
      const auto errors = profile_in_use<HeadingErrorProfile>(summary, swap.ack.target, window.after_ns + 1);
      return promised_difference_sigma(errors.relative_sigma_ned_m, errors.relative_gm_sigma_ned_m,
                                       errors.relative_gm_correlation_time_s, period_s, mask);
    };
    return fix_line(name, "m", swap.before.baseline_ned_m, swap.after.baseline_ned_m, promised(swap.before),
                    promised(swap.after), mask);
  };
  return {line("horizontal noise of the baseline", kHorizontal), line("vertical noise of the baseline", kVertical)};
}

}  // namespace inslab::evidence
