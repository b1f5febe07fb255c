#pragma once

#include <memory>
#include <optional>
#include <string>

#include "inslab/data/profiles/recorded_fix_error.hpp"
#include "inslab/data/samples/recorded_fix_errors.hpp"

namespace inslab::gnss {

/// Errors of a real receiver, epoch by epoch, on the simulated one: a function of sim time alone.
class RecordedFixes {
 public:
  /// What a run asks of a recording.
  struct Run {
    std::uint64_t seed = 0;
    std::string sensor;         ///< such as "gnss0": names the random stream
    time::Nanoseconds end{0};   ///< sim time of the last sample
    FixRecordingFinder find{};  ///< empty: there are no recordings
  };

  /// No recording.
  RecordedFixes() = default;
  /// Throws std::invalid_argument, naming the file, when the recording is not found or is too short for the run.
  RecordedFixes(const RecordedFixError& profile, const Run& run);

  bool is_off() const { return recording_ == nullptr; }

  /// The recorded epoch at sim time `t`: the one itself, or between two neighbours their errors in proportion with the
  /// worse one's fix type. Nothing where the receiver had no fix, and before the recording begins.
  std::optional<RecordedFixErrors::Epoch> at(time::Nanoseconds t) const;

 private:
  std::shared_ptr<const RecordedFixErrors> recording_;
  time::Nanoseconds from_{0};  ///< the recording's time at sim time 0
};

}  // namespace inslab::gnss
