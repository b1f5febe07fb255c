#include "inslab/models/timing/sensor_clock.hpp"

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::timing {
namespace {

std::int64_t in_ns(double seconds) { return time::from_seconds(seconds).count(); }

/// The nearest whole multiple of `count_ns`, halves up; both are not below 0.
std::int64_t whole_counts(std::int64_t time_ns, std::int64_t count_ns) {
  return (time_ns + count_ns / 2) / count_ns * count_ns;
}

}  // namespace

SensorClock::SensorClock(const TimeTagErrors& errors, double period_s, std::uint64_t seed, const std::string& sensor)
    : white_(random::Stream(seed, sensor + "/time_tag/white")),
      jitter_({}, period_s, random::Stream(seed, sensor + "/time_tag/gm")) {
  use(errors);
}

void SensorClock::use(const TimeTagErrors& errors) {
  errors_ = errors;
  is_off_ = errors.are_none();
  jitter_.retune({errors.gm_sigma_s, errors.gm_correlation_time_s});
}

void SensorClock::retune(const TimeTagErrors& errors, Continuity continuity, std::uint64_t k, std::int64_t time_ns) {
  if (continuity != Continuity::Keep || errors.drift_ppm != errors_.drift_ppm) drifts_since_ns_ = time_ns;
  use(errors);
  if (continuity == Continuity::Reset) jitter_.reset();
  if (continuity == Continuity::Redraw) jitter_.redraw(k);
}

StreamHeader SensorClock::tagged(const StreamHeader& header, std::uint64_t k) {
  if (is_off_) return header;
  double error_s =
      errors_.offset_s + 1e-6 * errors_.drift_ppm * time::to_seconds(header.sim_time_ns - drifts_since_ns_);
  for (const TimeTagStep& step : errors_.steps) {
    if (time::to_seconds(header.sim_time_ns) >= step.at_s) error_s += step.step_s;
  }
  if (errors_.white_sigma_s > 0.0) error_s += errors_.white_sigma_s * white_.at(k);
  error_s += jitter_.advance(k - 1);
  const time::GpsTime valid{header.gps_week, header.gps_time_of_week_ns};
  time::GpsTime tag = valid + time::Nanoseconds(in_ns(error_s));
  const std::int64_t count_ns = in_ns(errors_.quantization_s);
  if (count_ns > 0) {
    const std::int64_t whole_ns = whole_counts(tag.time_of_week_ns, count_ns);
    tag = tag + time::Nanoseconds(whole_ns - tag.time_of_week_ns);
  }
  StreamHeader tagged = header;
  tagged.gps_week = tag.week;
  tagged.gps_time_of_week_ns = tag.time_of_week_ns;
  return tagged;
}

}  // namespace inslab::timing
