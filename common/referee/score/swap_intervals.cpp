#include "inslab/referee/score/swap_intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::score {

SwapIntervals::SwapIntervals(const evidence::LogSummary& summary) {
  for (const evidence::ProfileInUse& entry : summary.profiles) {
    if (entry.apply_at_ns < 0) continue;
    const double time_s = time::to_seconds(entry.apply_at_ns);
    swaps_.push_back({time_s, fmt::format("{} '{}' for {} at {:.3f} s", enum_name(catalog::kind_of(entry.profile)),
                                          catalog::name_of(entry.profile),
                                          catalog::sensor_name(catalog::target_of(entry.profile)), time_s)});
  }
  std::stable_sort(swaps_.begin(), swaps_.end(), [](const Swap& a, const Swap& b) { return a.time_s < b.time_s; });
}

std::size_t SwapIntervals::at(double time_s) const {
  return static_cast<std::size_t>(
      std::count_if(swaps_.begin(), swaps_.end(), [time_s](const Swap& swap) { return swap.time_s < time_s; }));
}

std::string SwapIntervals::name(std::size_t interval) const {
  if (interval == 0) return "before the first swap";
  if (interval > swaps_.size()) return fmt::format("swap {}, which never came", interval);
  return swaps_[interval - 1].name;
}

double SwapIntervals::begin_s(std::size_t interval) const {
  if (interval == 0) return 0.0;
  return interval > swaps_.size() ? std::numeric_limits<double>::infinity() : swaps_[interval - 1].time_s;
}

}  // namespace inslab::score
