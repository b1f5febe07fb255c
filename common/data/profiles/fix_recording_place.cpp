#include "inslab/data/profiles/fix_recording_place.hpp"

#include <algorithm>
#include <stdexcept>

#include "inslab/foundation/fields/limits.hpp"

namespace inslab::profiles {
namespace {

/// Whole milliseconds come out as people write them.
std::string seconds_text(time::Nanoseconds t) { return number_text(static_cast<double>(t.count()) / 1e9); }

}  // namespace

time::Nanoseconds begin_of(const RecordedFixErrors& recording, const RecordedFixError& profile, time::Nanoseconds end,
                           double drawn) {
  const bool is_given = profile.from == RecordingStart::Given;
  const time::Nanoseconds lasts = recording.epochs.back().time;
  const time::Nanoseconds given = is_given ? time::from_seconds(profile.from_s) : time::Nanoseconds(0);
  if (given + end > lasts) {
    throw std::invalid_argument(profile.file + ": lasts " + seconds_text(lasts) + " s; the run" +
                                (is_given ? ", from " + number_text(profile.from_s) + " s on," : "") + " needs " +
                                seconds_text(given + end) + " s");
  }
  if (is_given) return given;
  // Epochs are where a real receiver's clock put them: the run begins at one, so that equal rates meet epoch by epoch.
  const auto& epochs = recording.epochs;
  const auto too_late = std::upper_bound(epochs.begin(), epochs.end(), lasts - end,
                                         [](time::Nanoseconds t, const auto& epoch) { return t < epoch.time; });
  const auto count = static_cast<double>(too_late - epochs.begin());
  return epochs[static_cast<std::size_t>(drawn * count)].time;
}

}  // namespace inslab::profiles
