#include "inslab/referee/score/solution_order.hpp"

namespace inslab::score {

void SolutionOrder::count_late(std::int64_t sim_time_ns, std::int64_t newest_ns, SolutionCounts& counts) {
  ++(sim_time_ns == newest_ns ? counts.duplicates : counts.out_of_order);
}

void SolutionOrder::add(const DatedSolution& dated, std::int64_t newest_truth_ns, SolutionCounts& counts) {
  const std::int64_t valid_ns = dated.sim_time_ns;
  if (!leaps_.empty() && leaps_.front().sim_time_ns <= newest_truth_ns) believe_leaps();
  if (!leaps_.empty() && valid_ns < leaps_.front().sim_time_ns) {
    counts.future += leaps_.size();
    leaps_.clear();
  }
  if (!leaps_.empty() && valid_ns <= leaps_.back().sim_time_ns) {
    count_late(valid_ns, leaps_.back().sim_time_ns, counts);
  } else if (newest_ns_ && valid_ns <= *newest_ns_) {
    count_late(valid_ns, *newest_ns_, counts);
  } else if (waiting_.size() + leaps_.size() >= most_waiting_) {
    ++counts.too_many;
  } else if (!leaps_.empty() ||
             (valid_ns > newest_truth_ns + leap_ns_ && (!newest_ns_ || valid_ns > *newest_ns_ + leap_ns_))) {
    leaps_.push_back(dated);
  } else {
    waiting_.push_back(dated);
    newest_ns_ = valid_ns;
  }
}

void SolutionOrder::believe_leaps() {
  waiting_.insert(waiting_.end(), leaps_.begin(), leaps_.end());
  newest_ns_ = leaps_.back().sim_time_ns;
  leaps_.clear();
}

std::optional<DatedSolution> SolutionOrder::take(std::int64_t sim_time_ns) {
  if (waiting_.empty() && !leaps_.empty() && leaps_.front().sim_time_ns <= sim_time_ns) believe_leaps();
  if (waiting_.empty() || waiting_.front().sim_time_ns > sim_time_ns) return std::nullopt;
  DatedSolution first = waiting_.front();
  waiting_.pop_front();
  return first;
}

void SolutionOrder::finish(SolutionCounts& counts) {
  counts.future += waiting_.size() + leaps_.size();
  waiting_.clear();
  leaps_.clear();
}

}  // namespace inslab::score
