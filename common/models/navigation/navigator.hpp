#pragma once

#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/models/navigation/tag_time.hpp"

namespace inslab::navigation {

/// The filter fed in the order in which a flight computer would have its inputs: of an observation
/// (measurements.hpp; a fix, for one) and an IMU sample, the one that is available first comes first, whatever the
/// order in which they are handed over here. It navigates by their tags (TagTime). So a run gives the same solutions in
/// lockstep, offline and from its log.
///
/// Who cannot know whether an earlier fix is still on its way leaves fixes_complete_up_to() at its default: each sample
/// then goes in at once, with the fixes that have come.
class Navigator {
 public:
  static constexpr std::int64_t kEver = std::numeric_limits<std::int64_t>::max();

  Navigator(const NavigationParameters& parameters, const nav::Gravity& gravity) : filter_(parameters, gravity) {}

  /// Begins at a known state instead of an alignment; see NavigationFilter::start().
  void start(const nav::NavState& state, std::int64_t time_ns) { filter_.start(state, time_ns); }

  /// The samples of one IMU, in their order.
  void add(const ImuSample& sample) { samples_.push_back(sample); }
  void add(const Observation& observation) {
    const std::uint32_t number = std::visit([](const auto& sample) { return number_of(sample); }, observation);
    observations_.emplace(Turn{available_at_ns(observation), observation.index(), number}, observation);
  }

  /// Every fix, and whatever else is observed, that is available at or before this sim time has been added.
  void fixes_complete_up_to(std::int64_t sim_time_ns) { complete_up_to_ns_ = sim_time_ns; }

  /// Takes in the next IMU sample whose turn has come, and says its sequence number and the solution, which there is
  /// none of when the sample was out of order; nothing when no sample's turn has come.
  struct Step {
    std::uint64_t imu_sequence = 0;
    std::optional<NavSolution> solution;
  };
  std::optional<Step> step();

  const NavigationFilter& filter() const { return filter_; }
  NavigationFilter& filter() { return filter_; }

 private:
  template <class Sample>
  static std::uint32_t number_of(const Sample& sample) {
    return sample.sensor_number;
  }
  static std::uint32_t number_of(const Standstill&) { return 0; }

  NavigationFilter filter_;
  TagTime tag_time_;
  std::deque<ImuSample> samples_;
  /// When an observation is available; of one time in the order of their kinds, and of one kind of their sensors'
  /// numbers, whichever stream came first.
  using Turn = std::tuple<std::int64_t, std::size_t, std::uint32_t>;
  std::multimap<Turn, Observation> observations_;
  std::int64_t complete_up_to_ns_ = kEver;
};

}  // namespace inslab::navigation
