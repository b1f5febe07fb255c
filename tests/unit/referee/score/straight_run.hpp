#pragma once

#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/referee/score/verdict.hpp"

namespace inslab::score {

/// Sim time 0 of these tests.
inline const time::GpsTime kStart{2399, 604'795'000'000'000};

inline std::int64_t ns(double seconds) { return static_cast<std::int64_t>(std::llround(seconds * 1e9)); }

inline void stamp(StreamHeader& header, double t_s) {
  const time::GpsTime gps = kStart + time::Nanoseconds(ns(t_s));
  header.sim_time_ns = ns(t_s);
  header.gps_week = gps.week;
  header.gps_time_of_week_ns = gps.time_of_week_ns;
}

/// A vehicle that stands at 30 deg north and looks north.
inline TruthState standing(double t_s) {
  TruthState truth;
  stamp(truth.header, t_s);
  truth.latitude_rad = 0.5235987755982988;
  truth.longitude_rad = 1.9896753472735358;
  truth.height_m = 20.0;
  truth.omega_iv_v = nav::omega_ie_n(truth.latitude_rad);
  return truth;
}

/// A solution for the vehicle's reference point that is off by `error_ned_m`.
inline NavSolution solution_at(const TruthState& truth, const Vector3& error_ned_m) {
  NavSolution solution;
  solution.gps_week = truth.header.gps_week;
  solution.gps_time_of_week_ns = truth.header.gps_time_of_week_ns;
  solution.reference_point = ReferencePoint::Vehicle;
  solution.mode = NavMode::Navigating;
  const nav::Geodetic place = nav::displaced(geodetic_of(truth), error_ned_m);
  solution.latitude_rad = place.latitude_rad;
  solution.longitude_rad = place.longitude_rad;
  solution.height_m = place.height_m;
  solution.v_n = truth.v_n;
  solution.q_n_body = truth.q_nv;
  solution.position_sigma_ned_m = solution.velocity_sigma_ned_m_per_s = solution.attitude_sigma_rad = Vector3::Ones();
  return solution;
}

inline scenario::Scenario scenario_with(std::vector<scenario::AcceptanceLimit> acceptance = {}) {
  scenario::Scenario scenario;
  scenario.imu.emplace_back();
  scenario.acceptance = std::move(acceptance);
  return scenario;
}

inline std::optional<double> in_all(const Scorer& scorer, scenario::Metric metric) {
  return figure(scorer, metric, {});
}

}  // namespace inslab::score
