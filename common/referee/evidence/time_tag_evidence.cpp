#include "inslab/referee/evidence/time_tag_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/evidence/evidence_lines.hpp"

namespace inslab::evidence {
namespace {

const Vector3 kTag(1.0, 0.0, 0.0);
constexpr double kCount_s = 1e-9;  // of a tag on the wire

template <class Profile, class = void>
inline constexpr bool has_clock = false;
template <class Profile>
inline constexpr bool has_clock<Profile, std::void_t<decltype(Profile::time_tag)>> = true;

TimeTagErrors clock_of(const catalog::AnyProfile* profile) {
  if (profile == nullptr) return {};
  return std::visit(
      [](const auto& one) {
        if constexpr (has_clock<std::decay_t<decltype(one)>>) return one.time_tag;
        return TimeTagErrors{};
      },
      *profile);
}

/// One side of a swap: the clock's errors there, and since when they drift.
class Side {
 public:
  Side(const LogSummary& summary, const SwapWindows& swap, const SwapWindow& window, double period_s)
      : window_(window), period_s_(period_s) {
    const std::int64_t at_ns = window.after_ns + 1;
    clock_ = clock_of(summary.in_use(swap.ack.kind, swap.ack.target, at_ns));
    // As SensorClock: from a swap on that brings another drift, or begins afresh.
    double drift_ppm = clock_of(summary.in_use(swap.ack.kind, swap.ack.target, 0)).drift_ppm;
    for (const ProfileInUse& entry : summary.profiles) {
      if (catalog::kind_of(entry.profile) != swap.ack.kind || !(catalog::target_of(entry.profile) == swap.ack.target) ||
          entry.apply_at_ns < 0 || entry.apply_at_ns >= at_ns) {
        continue;
      }
      const TimeTagErrors clock = clock_of(&entry.profile);
      if (catalog::request_of(entry.profile).continuity != Continuity::Keep || clock.drift_ppm != drift_ppm) {
        drifts_since_s_ = time::to_seconds(entry.apply_at_ns);
      }
      drift_ppm = clock.drift_ppm;
    }
  }

  bool has_errors() const { return !clock_.are_none(); }
  /// Whether the counts of the tags are noise: where the jitter is much narrower they beat with the rate.
  bool has_jitter() const { return clock_.quantization_s < 2.0 * clock_.white_sigma_s || clock_.quantization_s == 0.0; }

  Measured mean() const {
    const double time_s = window_.time_tag.mean().y();
    double promised_s = clock_.offset_s + 1e-6 * clock_.drift_ppm * (time_s - drifts_since_s_);
    for (const TimeTagStep& step : clock_.steps) promised_s += step.at_s <= begin_s() ? step.step_s : 0.0;
    const double error_s =
        std::hypot(clock_.white_sigma_s / std::sqrt(static_cast<double>(window_.time_tag.count())), clock_.gm_sigma_s);
    // The sensor takes a swap up at its next sample.
    const double since_s = 1e-6 * std::abs(clock_.drift_ppm) * 2.0 * period_s_;
    return judged(window_.time_tag.mean().x(), promised_s,
                  4.0 * error_s + 0.5 * clock_.quantization_s + since_s + steps_within_s() + kCount_s);
  }

  Measured jitter() const {
    const double white_s = std::hypot(clock_.white_sigma_s, clock_.quantization_s / std::sqrt(12.0));
    const double promised_s = promised_difference_sigma(kTag * white_s, kTag * clock_.gm_sigma_s,
                                                        kTag * clock_.gm_correlation_time_s, period_s_, kTag);
    const auto pairs = static_cast<double>(window_.time_tag.differences());
    return judged(window_.time_tag.pooled_white_sigma(kTag), promised_s,
                  sigma_tolerance(promised_s, pairs, kWhiteDifferences) +
                      1e-6 * std::abs(clock_.drift_ppm) * period_s_ + steps_within_s() / std::sqrt(2.0 * pairs) +
                      kCount_s);
  }

 private:
  double begin_s() const { return time::to_seconds(window_.after_ns); }
  double steps_within_s() const {
    double sum_s = 0.0;
    for (const TimeTagStep& step : clock_.steps) {
      if (step.at_s > begin_s() && step.at_s <= time::to_seconds(window_.until_ns)) sum_s += std::abs(step.step_s);
    }
    return sum_s;
  }

  const SwapWindow& window_;
  double period_s_;
  TimeTagErrors clock_;
  double drifts_since_s_ = 0.0;
};

}  // namespace

std::vector<EvidenceLine> time_tag_lines(const LogSummary& summary, const SwapWindows& swap, double period_s) {
  const Side before(summary, swap, swap.before, period_s), after(summary, swap, swap.after, period_s);
  if (!before.has_errors() && !after.has_errors()) return {};
  std::vector<EvidenceLine> lines{{"time tag", "s", before.mean(), after.mean()}};
  if (before.has_jitter() && after.has_jitter()) {
    lines.push_back({"jitter of the time tag", "s", before.jitter(), after.jitter()});
  }
  return lines;
}

}  // namespace inslab::evidence
