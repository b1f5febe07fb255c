#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "inslab/referee/evidence/log_summary.hpp"

namespace inslab::score {

/// The stretches of a run between its swaps, numbered as the phase swap_interval is: how many entries of the journal
/// have taken effect.
class SwapIntervals {
 public:
  explicit SwapIntervals(const evidence::LogSummary& summary);

  /// How many swaps there were; the interval of this number is the last.
  std::size_t count() const { return swaps_.size(); }
  /// The interval that a sim time lies in. An entry counts for what is later than its apply time.
  std::size_t at(double time_s) const;
  /// "imu_error 'adis16488' for imu0 at 20.000 s", and of interval 0 "before the first swap". A number past the last
  /// is that of an interval that never came, "swap 7, which never came".
  std::string name(std::size_t interval) const;
  /// Sim time from which the interval lasts, 0 of interval 0; to infinity where it never came.
  double begin_s(std::size_t interval) const;

 private:
  struct Swap {
    double time_s;
    std::string name;
  };
  std::vector<Swap> swaps_;  ///< in the order in which they took effect
};

}  // namespace inslab::score
