#include "inslab/models/imu/recorded_signal.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::imu {
namespace {

std::int64_t count_of(const RecordedErrors& recording) { return static_cast<std::int64_t>(recording.intervals.size()); }

}  // namespace

RecordedSignal::RecordedSignal(const RecordedError& profile, const Run& run) {
  if (profile.file.empty()) return;
  if (!run.find) throw std::invalid_argument(profile.file + ": there are no recordings here");
  try {
    recording_ = run.find(profile.file, profile.sha256);
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(error.what());
  }
  axes_ = profile.axes;
  place_ = profiles::place_of(*recording_, profile, run.end,
                              random::Stream(run.seed, run.sensor + "/recorded_error").uniform(0));
  if (place_.crossfade > 0) find_mean();
}

/// What the crossfade leaves as it is: two signals whose shares add up to more than one would have more of it.
void RecordedSignal::find_mean() {
  for (const RecordedErrors::Increments& interval : recording_->intervals) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) mean_[axis] += interval[axis];
  }
  for (double& mean : mean_) mean /= static_cast<double>(recording_->intervals.size());
}

/// Interval `number` of the recording, or of its endless continuation: each turn but the first begins with the end of
/// the one before fading out. The shares of what departs from the mean are a sine and a cosine, so that the power of
/// two signals that know nothing of each other stays what it was.
RecordedErrors::Increments RecordedSignal::interval(std::int64_t number) const {
  if (number < 0) return {};
  const std::int64_t turn = count_of(*recording_) - place_.crossfade;
  const std::int64_t place = place_.crossfade > 0 ? number % turn : number;
  const RecordedErrors::Increments& here = recording_->intervals[static_cast<std::size_t>(place)];
  if (place_.crossfade == 0 || number < turn || place >= place_.crossfade) return here;
  const RecordedErrors::Increments& ending = recording_->intervals[static_cast<std::size_t>(turn + place)];
  const double angle = 0.5 * units::kPi * (static_cast<double>(place) + 0.5) / static_cast<double>(place_.crossfade);
  RecordedErrors::Increments mixed{};
  for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
    mixed[axis] =
        mean_[axis] + std::sin(angle) * (here[axis] - mean_[axis]) + std::cos(angle) * (ending[axis] - mean_[axis]);
  }
  return mixed;
}

Increments RecordedSignal::between(std::int64_t from_ns, std::int64_t to_ns) const {
  Increments sum;
  if (is_off()) return sum;
  const time::Rate& rate = recording_->rate;
  const auto take = [&](std::uint64_t grid_interval, double part) {
    const RecordedErrors::Increments errors = interval(static_cast<std::int64_t>(grid_interval) + place_.first);
    if (axes_ != RecordedAxes::Accel) sum.dtheta += part * Vector3(errors[0], errors[1], errors[2]);
    if (axes_ != RecordedAxes::Gyro) sum.dv += part * Vector3(errors[3], errors[4], errors[5]);
  };
  std::uint64_t k = rate.index(time::Nanoseconds(from_ns));
  for (std::int64_t at_ns = from_ns; at_ns < to_ns; ++k) {
    const std::int64_t begin_ns = rate.at(k).count();
    const std::int64_t end_ns = rate.at(k + 1).count();
    const std::int64_t until_ns = std::min(end_ns, to_ns);
    take(k, static_cast<double>(until_ns - at_ns) / static_cast<double>(end_ns - begin_ns));
    at_ns = until_ns;
  }
  return sum;
}

}  // namespace inslab::imu
