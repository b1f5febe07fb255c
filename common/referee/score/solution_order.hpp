#pragma once

#include <array>
#include <deque>
#include <optional>

#include "inslab/data/samples/nav_solution.hpp"

namespace inslab::score {

/// What was heard of an app besides its errors.
struct SolutionCounts {
  std::uint64_t received = 0;
  std::uint64_t scored = 0;
  std::uint64_t stale = 0;         ///< valid long before the IMU sample it names, or before the truth that is kept
  std::uint64_t future = 0;        ///< long after the IMU sample it names or the truth, or a leap that was taken back
  std::uint64_t non_finite = 0;    ///< not finite, outside the domain, or no rotation
  std::uint64_t duplicates = 0;    ///< as valid as the one before
  std::uint64_t out_of_order = 0;  ///< valid before one that came earlier
  std::uint64_t too_many = 0;      ///< came faster than truth does, and had no room to wait
  std::array<std::uint64_t, EnumNames<NavMode>::values.size()> modes{};
};

/// A solution and its time of validity.
struct DatedSolution {
  std::int64_t sim_time_ns;
  NavSolution solution;
};

/// Solutions that wait for the truth of their time, in order of validity.
///
/// In lockstep an app may hear the truth well before we do, so a solution beyond the newest truth is not wrong for
/// that. But one that leaps ahead of the truth and of the solution before it waits apart until the truth has reached
/// it: if the app then goes on from before the leap, the leap was of the future, and the order is as if it never came.
class SolutionOrder {
 public:
  SolutionOrder(std::size_t most_waiting, std::int64_t leap_ns) : most_waiting_(most_waiting), leap_ns_(leap_ns) {}

  /// In the order in which solutions came. Counts the one that has no place.
  void add(const DatedSolution& dated, std::int64_t newest_truth_ns, SolutionCounts& counts);

  /// The first in order whose time is not after `sim_time_ns`; nothing when there is none.
  std::optional<DatedSolution> take(std::int64_t sim_time_ns);

  /// No more truth comes: what waits is of the future.
  void finish(SolutionCounts& counts);

 private:
  void believe_leaps();
  static void count_late(std::int64_t sim_time_ns, std::int64_t newest_ns, SolutionCounts& counts);

  std::size_t most_waiting_;
  std::int64_t leap_ns_;
  std::deque<DatedSolution> waiting_;
  std::deque<DatedSolution> leaps_;        ///< a leap and what followed it, all after `newest_ns_`
  std::optional<std::int64_t> newest_ns_;  ///< in order
};

}  // namespace inslab::score
