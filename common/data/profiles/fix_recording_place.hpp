#pragma once

#include "inslab/data/profiles/recorded_fix_error.hpp"
#include "inslab/data/samples/recorded_fix_errors.hpp"

namespace inslab::profiles {

/// The recording's time at sim time 0 for a run up to `end`; `drawn`, in [0, 1), chooses among the epochs from which it
/// lasts, where the profile leaves it to the seed. Throws std::invalid_argument, naming the file, when it does not
/// last.
time::Nanoseconds begin_of(const RecordedFixErrors& recording, const RecordedFixError& profile, time::Nanoseconds end,
                           double drawn);

}  // namespace inslab::profiles
