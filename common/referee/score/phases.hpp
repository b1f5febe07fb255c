#pragma once

#include <map>
#include <vector>

#include "inslab/referee/score/error_statistics.hpp"
#include "inslab/scenario/acceptance.hpp"

namespace inslab::score {

/// Which solutions an ErrorStatistics is about.
struct PhaseKey {
  scenario::Phase phase = scenario::Phase::All;
  std::uint32_t swap_interval = 0;
  double after_s = 0.0;

  friend bool operator<(const PhaseKey& a, const PhaseKey& b) {
    if (a.after_s != b.after_s) return a.after_s < b.after_s;
    return a.phase != b.phase ? a.phase < b.phase : a.swap_interval < b.swap_interval;
  }
};

/// What decides to which phases a time belongs.
struct PhaseInstant {
  std::int64_t sim_time_ns = 0;
  bool in_outage = false;
  std::uint32_t swaps = 0;  ///< entries of the journal in effect
};

/// The errors of the solutions, phase by phase: all phases of the whole run, and after each time that an acceptance
/// line gives all, outages, between outages and the swap intervals that lines ask for.
class Phases {
 public:
  /// Swap intervals from `most_swap_intervals` on that no line asks for count in that one.
  Phases(const std::vector<scenario::AcceptanceLimit>& acceptance, std::size_t most_swap_intervals);

  void add(const PhaseInstant& moment, const SolutionError& error, const NavSolution& solution);
  /// An interval of the truth, of that length, and whether a solution covered it.
  void add_time(const PhaseInstant& end, double seconds, bool covered);

  const std::map<PhaseKey, ErrorStatistics>& all() const { return phases_; }

 private:
  template <class Each>
  void for_each_phase_of(const PhaseInstant& moment, const Each& each);

  std::uint32_t most_swap_intervals_;
  std::vector<double> after_s_{0.0};
  std::map<PhaseKey, ErrorStatistics> phases_;
};

}  // namespace inslab::score
