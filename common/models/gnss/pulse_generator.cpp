#include "inslab/models/gnss/pulse_generator.hpp"

#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::gnss {
namespace {

constexpr std::int64_t kSecondNs = 1'000'000'000;

}  // namespace

PulseGenerator::PulseGenerator(const random::Stream& root)
    : white_(root.child("/white")),
      missing_(root.child("/missing")),
      first_phase_ticks_(root.child("/phase").uniform(0)) {}

void PulseGenerator::note_epoch(std::int64_t sim_time_ns, bool has_fix) {
  has_fix_ = has_fix;
  if (has_fix) last_fix_ns_ = sim_time_ns;
}

/// How much later than meant the nearest tick is. Whole ticks drop out of the phase, so that it stays exact.
double PulseGenerator::to_the_next_tick_ns(std::uint64_t second, double meant_ns) const {
  const double period_ns = errors_.quantization_ns;
  if (!(period_ns > 0.0)) return 0.0;
  const double ticks_a_second =
      static_cast<double>(kSecondNs) * (1.0 + 1e-9 * errors_.oscillator_drift_ppb) / period_ns;
  const double gained = std::remainder(ticks_a_second, 1.0) * static_cast<double>(second);
  return -std::remainder(first_phase_ticks_ + gained + meant_ns / period_ns, 1.0) * period_ns;
}

/// `second` is the header of a whole second.
std::optional<Pulse> PulseGenerator::pulse_of(const StreamHeader& second) {
  const auto number = static_cast<std::uint64_t>(second.sim_time_ns / kSecondNs);
  if (last_fix_ns_ < 0) return std::nullopt;
  const double without_fix_s = has_fix_ ? 0.0 : time::to_seconds(second.sim_time_ns - last_fix_ns_);
  if (without_fix_s > errors_.holdover_s) return std::nullopt;
  if (missing_.uniform(number) < errors_.missing_probability) return std::nullopt;
  Pulse pulse;
  pulse.truth.header = pulse.sample.header = second;
  pulse.truth.offset_ns = errors_.offset_ns;
  if (errors_.white_sigma_ns > 0.0) pulse.truth.jitter_ns = errors_.white_sigma_ns * white_.at(number);
  pulse.truth.holdover_ns = errors_.holdover_drift_ppb * without_fix_s;
  pulse.truth.quantization_ns = to_the_next_tick_ns(number, pulse.truth.error_ns());
  pulse.sample.quantization_error_ns = pulse.truth.quantization_ns;
  pulse.sample.in_holdover = !has_fix_;
  pulse.sample.header.sim_time_ns += std::llround(pulse.truth.error_ns());
  return pulse;
}

std::optional<Pulse> PulseGenerator::at(const TruthState& truth, const GnssRevisions& revisions) {
  if (!errors_.on && !is_due_) return std::nullopt;
  const std::int64_t now_ns = truth.header.sim_time_ns;
  const std::int64_t since_second_ns = truth.header.gps_time_of_week_ns % kSecondNs;
  if (errors_.on && since_second_ns < truth.interval_ns && now_ns > since_second_ns) {
    StreamHeader second = truth.header;
    second.sim_time_ns = now_ns - since_second_ns;
    second.gps_time_of_week_ns -= since_second_ns;
    if (const std::optional<Pulse> pulse = pulse_of(second)) {
      due_ = *pulse;
      due_.sample.revisions = due_.truth.revisions = revisions;
      is_due_ = true;
    }
  }
  if (!is_due_ || due_.sample.header.sim_time_ns > now_ns) return std::nullopt;
  is_due_ = false;
  return due_;
}

}  // namespace inslab::gnss
