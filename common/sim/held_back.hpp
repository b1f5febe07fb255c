#pragma once

#include <deque>
#include <optional>
#include <tuple>
#include <type_traits>
#include <vector>

#include "inslab/data/samples/measured.hpp"
#include "inslab/foundation/fields/types.hpp"

namespace inslab::sim {

/// The samples of a sensor that a fault delays: each comes out at the first truth sample that is so much later than the
/// sample's own time, with its tags, and says when an app has it. With a shorter delay, or none, those that are due
/// come at once, in their order: none is lost, and what comes behind them is as without the fault. What is held back
/// when the run ends does not come out.
template <class Wiring>
class HeldBack {
 public:
  using Output = typename Wiring::Output;

  /// At truth sample `now_ns`: takes `output`, if there is one, and gives what comes out now.
  void pass(std::int64_t now_ns, std::int64_t delay_ns, std::vector<Output>& late, std::optional<Output>& output) {
    if (delay_ns <= 0 && held_.empty()) return;
    if (output) held_.push_back(*output);
    output.reset();
    while (!held_.empty() && valid_at_ns(held_.front()) <= now_ns - delay_ns) {
      late.push_back(held_.front());
      held_.pop_front();
      auto& sample = std::get<0>(Wiring::samples(late.back()));
      make_available_at(sample, available_at_ns(sample) + now_ns - sample.header.sim_time_ns);
    }
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp).
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    auto count = static_cast<std::uint64_t>(self.held_.size());
    visit(count);
    if constexpr (std::is_const_v<Self>) {
      for (Output output : self.held_) visit_samples(output, visit);
    } else {
      self.held_.resize(count);
      for (Output& output : self.held_) visit_samples(output, visit);
    }
  }

 private:
  template <class Visitor>
  static void visit_samples(Output& output, Visitor& visit) {
    for_each_of(Wiring::samples(output), [&visit](auto& sample) { visit(sample); });
  }
  static std::int64_t valid_at_ns(Output& output) { return std::get<0>(Wiring::samples(output)).header.sim_time_ns; }

  std::deque<Output> held_;
};

}  // namespace inslab::sim
