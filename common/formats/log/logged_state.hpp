#pragma once

#include <cmath>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::log {

/// What a sample of the truth or of a navigation app says of the vehicle.
struct LoggedState {
  time::Nanoseconds time{0};  ///< from a zero that all samples of the topic share
  time::GpsTime gps;
  nav::Geodetic position;
  nav::Vector3 v_n;
  nav::Quaternion q_nv;
  bool is_solution = true;  ///< false: an app that does not navigate yet

  /// Whether it can be a row: everything finite and in the valid domain, the quaternion a rotation.
  bool in_range() const {
    return nav::in_domain(position) && v_n.allFinite() && std::abs(q_nv.norm() - 1.0) < 1e-3 && gps.week <= 10000;
  }
  /// The row's time is left 0.
  TrajectoryRow row() const { return {time::Nanoseconds(0), position, v_n, nav::rpy_from_quaternion(q_nv)}; }
};

inline LoggedState state_of(const TruthState& truth) {
  return {time::Nanoseconds(truth.header.sim_time_ns),
          {truth.header.gps_week, truth.header.gps_time_of_week_ns},
          geodetic_of(truth),
          truth.v_n,
          truth.q_nv};
}

inline LoggedState state_of(const NavSolution& nav) {
  const time::GpsTime gps{nav.gps_week, nav.gps_time_of_week_ns};
  // A week that no GPS time has, of an app gone wrong, would overflow the count of nanoseconds; in_range() is false.
  const time::Nanoseconds since_zero = nav.gps_week > time::kLastGpsWeek ? time::Nanoseconds(0) : gps - time::GpsTime{};
  return {since_zero, gps,          geodetic_of(nav),
          nav.v_n,    nav.q_n_body, nav.mode == NavMode::Navigating || nav.mode == NavMode::Coasting};
}

}  // namespace inslab::log
