#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::score {

/// How regularly solutions come, by their times of validity, which increase.
class Rhythm {
 public:
  /// A longer silence is a gap.
  explicit Rhythm(std::int64_t gap_ns) : gap_ns_(gap_ns) {}

  void note(std::int64_t sim_time_ns) {
    if (count_ == 0) first_ns_ = last_ns_ = sim_time_ns;
    note_silence(sim_time_ns - last_ns_);
    last_ns_ = sim_time_ns;
    ++count_;
  }
  /// The run ends: an app that fell silent before has been silent until then.
  void finish(std::int64_t sim_time_ns) {
    if (count_ > 0) note_silence(sim_time_ns - last_ns_);
  }

  /// Intervals between solutions over the time they take; nothing with fewer than two.
  std::optional<double> rate_hz() const {
    if (count_ < 2) return std::nullopt;
    return static_cast<double>(count_ - 1) / (time::to_seconds(last_ns_ - first_ns_));
  }
  std::optional<double> first_solution_s() const {
    return count_ == 0 ? std::nullopt : std::optional<double>(time::to_seconds(first_ns_));
  }
  /// From a solution to the next, or to the end of the run.
  std::optional<double> longest_gap_s() const {
    return count_ == 0 ? std::nullopt : std::optional<double>(time::to_seconds(longest_silence_ns_));
  }
  std::uint64_t gaps() const { return gaps_; }

 private:
  void note_silence(std::int64_t silence_ns) {
    longest_silence_ns_ = std::max(longest_silence_ns_, silence_ns);
    if (silence_ns > gap_ns_) ++gaps_;
  }

  std::int64_t gap_ns_;
  std::int64_t first_ns_ = 0;
  std::int64_t last_ns_ = 0;
  std::int64_t longest_silence_ns_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t gaps_ = 0;
};

}  // namespace inslab::score
