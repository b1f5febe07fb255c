#pragma once

#include <cstdint>

#include "inslab/data/profiles/recorded_error.hpp"
#include "inslab/data/samples/recorded_errors.hpp"

namespace inslab::profiles {

/// Where a run takes its errors from a recording, in intervals of the recording.
struct RecordingPlace {
  std::int64_t first = 0;      ///< the one that begins at sim time 0; below 0 the recording begins later
  std::int64_t crossfade = 0;  ///< how many fade; above 0: after its end it begins anew
};

/// The place for a run whose last sample is at sim time `end`; `drawn`, in [0, 1), chooses where the profile leaves it
/// to the seed. Throws std::invalid_argument, naming the file, when the recording does not last.
RecordingPlace place_of(const RecordedErrors& recording, const RecordedError& profile, time::Nanoseconds end,
                        double drawn);

}  // namespace inslab::profiles
