#include "io/trajectory_log.hpp"

#include "io/log_topic.hpp"
#include "io/trajectory_rows.hpp"

namespace inslab::io {

namespace {

/// What one sample says of the vehicle.
struct LoggedState {
  time::Nanoseconds time{0};
  time::GpsTime gps;
  nav::Geodetic position;
  nav::Vector3 v_n;
  nav::Quaternion q_nv;
  bool is_solution = true;  ///< false: an app that does not navigate yet
};

LoggedState state_of(const TruthState& truth) {
  return {time::Nanoseconds(truth.header.sim_time_ns),
          {truth.header.gps_week, truth.header.gps_time_of_week_ns},
          {truth.latitude_rad, truth.longitude_rad, truth.height_m},
          truth.v_n,
          truth.q_nv};
}

LoggedState state_of(const NavSolution& nav) {
  const time::GpsTime gps{nav.gps_week, nav.gps_time_of_week_ns};
  return {gps - time::GpsTime{},
          gps,
          {nav.latitude_rad, nav.longitude_rad, nav.height_m},
          nav.v_n,
          nav.q_n_body,
          nav.mode == NavMode::Navigating || nav.mode == NavMode::Coasting};
}

bool in_range(const LoggedState& state) {
  return nav::in_domain(state.position) && state.v_n.allFinite() && std::abs(state.q_nv.norm() - 1.0) < 1e-3 &&
         state.gps.week <= 10000;
}

template <class T>
void read_topic(const McapReader& log, const TrajectoryReadOptions& options, TrajectoryReading& reading) {
  TrajectoryRows rows(reading);
  const auto add = [&](const T& sample, std::uint64_t number) {
    const LoggedState state = state_of(sample);
    if (!state.is_solution) return true;
    if (in_range(state)) {
      rows.add(number, state.time, state.gps, {{}, state.position, state.v_n, nav::rpy_from_quaternion(state.q_nv)});
    } else {
      reading.problems.add({Rule::ValueRange, "message " + std::to_string(number),
                            "has a position, velocity or attitude outside the valid domain or not finite"});
    }
    return !options.stop_at_first || reading.problems.empty();
  };
  const std::uint64_t unreadable = for_each_sample<T>(log, options.topic, add);
  if (unreadable > 0) {
    reading.problems.add({Rule::ValueType, options.topic,
                          "has " + std::to_string(unreadable) + " messages that are not what their type says"});
  }
}

}  // namespace

TrajectoryReading read_trajectory_log(const std::string& path, const TrajectoryReadOptions& options) {
  const McapReader log(path);
  TrajectoryReading reading;
  if (!channels_of(log, options.topic, wire::WireType<NavSolution>::name).empty()) {
    read_topic<NavSolution>(log, options, reading);
  } else if (!channels_of(log, options.topic, wire::WireType<TruthState>::name).empty()) {
    read_topic<TruthState>(log, options, reading);
  } else {
    reading.problems.add(
        {Rule::FileColumns, "",
         "has no topic " + options.topic + " with a truth or a navigation solution; it has " + topics_text(log)});
  }
  return reading;
}

}  // namespace inslab::io
