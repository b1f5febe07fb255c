#include "inslab/referee/score/outages.hpp"

#include <algorithm>
#include <cmath>

namespace inslab::score {

namespace {

constexpr std::size_t kMostOutages = 10000;
constexpr std::int64_t kSilentReceiver_ns = 5'000'000'000;  // nobody waits longer for an epoch

}  // namespace

void Outages::add(std::int64_t sim_time_ns, bool has_fix) {
  if (!epochs_.empty() && sim_time_ns <= epochs_.back().sim_time_ns) return;
  epochs_.push_back({sim_time_ns, has_fix});
}

bool Outages::can_tell(std::int64_t sim_time_ns, std::int64_t newest_truth_ns) const {
  return period_ns_ == 0 || (!epochs_.empty() && epochs_.back().sim_time_ns >= sim_time_ns) ||
         newest_truth_ns - sim_time_ns > std::max(kSilentReceiver_ns, 3 * period_ns_);
}

bool Outages::contains(std::int64_t sim_time_ns, std::int64_t newest_truth_ns) {
  while (!epochs_.empty() && epochs_.front().sim_time_ns <= sim_time_ns) {
    if (epochs_.front().has_fix) {
      last_fix_ns_ = epochs_.front().sim_time_ns;
      if (open_) outages_.back().end_ns = *last_fix_ns_;
      open_ = false;
    }
    epochs_.pop_front();
  }
  if (open_ || !last_fix_ns_ || *last_fix_ns_ == sim_time_ns) return open_;
  const std::int64_t next_ns = epochs_.empty() ? newest_truth_ns : epochs_.front().sim_time_ns;
  const bool epoch_missing = 2 * (next_ns - *last_fix_ns_) > 3 * period_ns_;
  const bool next_is_none = !epochs_.empty() && !epochs_.front().has_fix;
  if ((epoch_missing || next_is_none) && outages_.size() < kMostOutages) {
    open_ = true;
    outages_.push_back({*last_fix_ns_, next_ns, 0, 0.0, 0.0});
  }
  return open_;
}

void Outages::note(const SolutionError& error) {
  if (!open_) return;
  OutageDrift& drift = outages_.back();
  ++drift.solutions;
  drift.horizontal_m = std::max(drift.horizontal_m, error.position_ned_m.head<2>().norm());
  drift.vertical_m = std::max(drift.vertical_m, std::abs(error.position_ned_m.z()));
}

void Outages::finish(std::int64_t newest_truth_ns) {
  if (open_) outages_.back().end_ns = newest_truth_ns;
}

}  // namespace inslab::score
