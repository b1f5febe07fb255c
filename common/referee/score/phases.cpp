#include "inslab/referee/score/phases.hpp"

#include <algorithm>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::score {

using scenario::Phase;

Phases::Phases(const std::vector<scenario::AcceptanceLimit>& acceptance, std::size_t most_swap_intervals)
    : most_swap_intervals_(static_cast<std::uint32_t>(most_swap_intervals)) {
  for (const scenario::AcceptanceLimit& line : acceptance) {
    if (std::find(after_s_.begin(), after_s_.end(), line.after_s) == after_s_.end()) after_s_.push_back(line.after_s);
    if (line.phase == Phase::SwapInterval) phases_[{line.phase, line.swap_interval, line.after_s}];
  }
}

void Phases::add(const PhaseInstant& moment, const SolutionError& error, const NavSolution& solution) {
  for_each_phase_of(moment, [&](ErrorStatistics& statistics) { statistics.add(error, solution); });
}

void Phases::add_time(const PhaseInstant& end, double seconds, bool covered) {
  for_each_phase_of(end, [&](ErrorStatistics& statistics) { statistics.add_time(seconds, covered); });
}

template <class Each>
void Phases::for_each_phase_of(const PhaseInstant& moment, const Each& each) {
  for (const double after_s : after_s_) {
    if (time::to_seconds(moment.sim_time_ns) < after_s) continue;
    each(phases_[{Phase::All, 0, after_s}]);
    each(phases_[{moment.in_outage ? Phase::Outages : Phase::BetweenOutages, 0, after_s}]);
    const auto asked_for = phases_.find({Phase::SwapInterval, moment.swaps, after_s});
    if (asked_for != phases_.end()) {
      each(asked_for->second);
    } else if (after_s == 0.0) {
      each(phases_[{Phase::SwapInterval, std::min(moment.swaps, most_swap_intervals_), after_s}]);
    }
  }
}

}  // namespace inslab::score
