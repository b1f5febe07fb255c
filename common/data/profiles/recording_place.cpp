#include "inslab/data/profiles/recording_place.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/foundation/fields/limits.hpp"

namespace inslab::profiles {
namespace {

/// How many intervals of a grid a run up to `end` takes something of.
std::int64_t intervals_up_to(const time::Rate& rate, time::Nanoseconds end) {
  return end.count() <= 0 ? 1 : 1 + static_cast<std::int64_t>(rate.index(end - time::Nanoseconds(1)));
}

[[noreturn]] void too_short(const RecordedError& profile, const time::Rate& rate, std::int64_t has,
                            const std::string& needs) {
  throw std::invalid_argument(profile.file + ": lasts " + number_text(static_cast<double>(has) * rate.period_s()) +
                              " s; " + needs);
}

}  // namespace

RecordingPlace place_of(const RecordedErrors& recording, const RecordedError& profile, time::Nanoseconds end,
                        double drawn) {
  const time::Rate& rate = recording.rate;
  const auto count = static_cast<std::int64_t>(recording.intervals.size());
  RecordingPlace place;
  if (profile.loop == RecordingEnd::Crossfade) {
    place.crossfade = std::max<std::int64_t>(1, std::llround(profile.crossfade_s * rate.hz()));
    if (2 * place.crossfade > count) {
      too_short(profile, rate, count, "a crossfade of " + number_text(profile.crossfade_s) + " s takes twice its own");
    }
  }
  const std::int64_t needed = intervals_up_to(rate, end);
  const std::int64_t spare = place.crossfade > 0 ? count - 1 : count - needed;
  const bool is_given = profile.from == RecordingStart::Given;
  place.first = is_given ? std::llround(profile.from_s * rate.hz())
                         : static_cast<std::int64_t>(drawn * static_cast<double>(spare + 1));
  if (place.crossfade == 0 && (is_given ? place.first > spare : spare < 0)) {
    const std::string from = is_given ? ", from " + number_text(profile.from_s) + " s on," : "";
    const std::int64_t whole = needed + (is_given ? place.first : 0);
    too_short(profile, rate, count,
              "the run" + from + " needs " + number_text(static_cast<double>(whole) * rate.period_s()) +
                  " s (loop: crossfade goes on after the end)");
  }
  return place;
}

}  // namespace inslab::profiles
