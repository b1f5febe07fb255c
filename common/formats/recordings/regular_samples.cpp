#include "inslab/formats/recordings/regular_samples.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::recordings {
namespace {

constexpr std::size_t kSamplesForInterval = 1000;

}  // namespace

void RegularSamples::take(const RawSample& raw) {
  if (!begun_) {
    waiting_.push_back(raw);
    if (waiting_.size() == kSamplesForInterval) flush();
    return;
  }
  pass(raw);
}

void RegularSamples::finish() {
  if (!begun_) flush();
}

void RegularSamples::flush() {
  if (waiting_.size() < 3) {
    throw files::ReadError(path_ + ": has " + std::to_string(waiting_.size()) +
                           " samples of an IMU; expected at least 3");
  }
  std::vector<double> intervals;
  for (std::size_t i = 1; i < waiting_.size(); ++i) intervals.push_back(waiting_[i].time_s - waiting_[i - 1].time_s);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  if (!(*middle > 0.0)) throw files::ReadError(path_ + ": its times do not increase");
  // A time as printed has its own rounding; the mean of those intervals near the median has less of it. What is left
  // near a whole number of nanoseconds is not the sensor's; 300 Hz has a third of one.
  double sum = 0.0, count = 0.0;
  for (const double interval : intervals) {
    if (std::abs(interval - *middle) > 0.5 * *middle) continue;
    sum += interval;
    count += 1.0;
  }
  const double mean_ns = 1e9 * sum / count;
  constexpr double kRounding_ns = 0.02;
  info_.dt_s = 1e-9 * (std::abs(mean_ns - std::round(mean_ns)) < kRounding_ns ? std::round(mean_ns) : mean_ns);
  judge();
  begun_ = true;
  begin_(info_);
  for (const RawSample& raw : waiting_) pass(raw);
  waiting_.clear();
}

/// Refuses what cannot be what it is taken for: seconds of which no IMU is that slow, and increments that are rates.
void RegularSamples::judge() const {
  constexpr double kSlowest_s = 10.0, kG = units::kG;
  const std::string remedy =
      "; name the columns in a line above, such as time_ns,gyro_x_rad_per_s,...,accel_z_m_per_s2";
  if (info_.dt_s > kSlowest_s) {
    throw files::ReadError(path_ + ": has a sample each " + std::to_string(info_.dt_s) +
                           " s if its times are seconds, which no IMU has: they may be milli-, micro- or nanoseconds" +
                           (place_name_ == "line" ? remedy : ""));
  }
  double force[3] = {};
  for (const RawSample& raw : waiting_) {
    for (std::size_t i = 0; i < 3; ++i) force[i] += raw.values[3 + i] / static_cast<double>(waiting_.size());
  }
  const double as_it_is = std::hypot(force[0], force[1], force[2]);
  if (is_rate_[3] || is_rate_[4] || is_rate_[5] || std::abs(as_it_is - kG) > 0.05 * kG) return;
  if (as_it_is / info_.dt_s < 10.0 * kG) return;
  throw files::ReadError(path_ + ": has a mean of " + std::to_string(as_it_is) +
                         " in its accelerometer columns, which is gravity as a rate, in m/s^2; as increments over " +
                         std::to_string(info_.dt_s) + " s, for which unnamed columns are taken, it would be " +
                         std::to_string(as_it_is / info_.dt_s) + " m/s^2" + remedy);
}

void RegularSamples::pass(const RawSample& raw) {
  if (last_time_s_) {
    const double interval_s = raw.time_s - *last_time_s_;
    const std::string place = path_ + ": " + place_name_ + " " + std::to_string(raw.place);
    if (!(interval_s > 0.0)) throw files::ReadError(place + ": its time is not after the one before");
    if (std::abs(interval_s - info_.dt_s) > 0.5 * info_.dt_s) {
      ++info_.gaps;
      if (!options_.over_gaps) {
        throw files::ReadError(place + ": comes " + std::to_string(interval_s) + " s after the one before; expected " +
                               std::to_string(info_.dt_s) + " s (--over-gaps: go on as though nothing were missing)");
      }
    }
  }
  last_time_s_ = raw.time_s;
  ImuIncrements increments = raw.values;
  for (std::size_t i = 0; i < kImuAxes; ++i) {
    if (is_rate_[i]) increments[i] *= info_.dt_s;
  }
  ++info_.samples;
  sample_(increments);
}

}  // namespace inslab::recordings
