#include "inslab/formats/trajectory/trajectory_log.hpp"

#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/log/logged_state.hpp"
#include "inslab/formats/trajectory/trajectory_rows.hpp"

namespace inslab::trajectory {

namespace {

template <class T>
void read_topic(const mcap::McapReader& log, const TrajectoryReadOptions& options, TrajectoryReading& reading) {
  TrajectoryRows rows(reading);
  const auto add = [&](const T& sample, std::uint64_t number) {
    const log::LoggedState state = log::state_of(sample);
    if (!state.is_solution) return true;
    if (state.in_range()) {
      rows.add(number, state.time, state.gps, state.row());
    } else {
      reading.problems.add({Rule::ValueRange, "message " + std::to_string(number),
                            "has a position, velocity or attitude outside the valid domain or not finite"});
    }
    return !rows.is_full() && (!options.stop_at_first || reading.problems.empty());
  };
  const std::uint64_t unreadable = log::for_each_sample<T>(log, options.topic, add);
  if (unreadable > 0) {
    reading.problems.add({Rule::ValueType, options.topic,
                          "has " + std::to_string(unreadable) + " messages that are not what their type says"});
  }
}

}  // namespace

TrajectoryReading read_trajectory_log(const std::string& path, const TrajectoryReadOptions& options) {
  const mcap::McapReader log(path);
  TrajectoryReading reading;
  if (!log::channels_of(log, options.topic, catalog::WireType<NavSolution>::name).empty()) {
    read_topic<NavSolution>(log, options, reading);
  } else if (!log::channels_of(log, options.topic, catalog::WireType<TruthState>::name).empty()) {
    read_topic<TruthState>(log, options, reading);
  } else {
    reading.problems.add(
        {Rule::FileColumns, "",
         "has no topic " + options.topic + " with a truth or a navigation solution; it has " + log::topics_text(log)});
  }
  return reading;
}

}  // namespace inslab::trajectory
