// A live vehicle for tests: its states come from a motion table in place of a simulator.

#pragma once

#include <cmath>
#include <vector>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/trajectory/live_vehicle_model.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/scenario/terrain_gravity.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory::live_vehicle {

inline constexpr double kStateRate_hz = 100.0;
inline constexpr double kTruthRate_hz = 200.0;
inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
inline constexpr time::GpsTime kStart{2300, 0};

inline nav::Geodetic position(const TruthState& truth) { return geodetic_of(truth); }

/// A drive that swerves, rolls, and changes speed; it begins and goes on smoothly.
inline scenario::Trajectory drive(double latitude_deg = 48.0, double longitude_deg = 11.0) {
  using scenario::Axis;
  using scenario::MotionType;
  scenario::Trajectory trajectory;
  trajectory.initial.latitude_deg = latitude_deg;
  trajectory.initial.longitude_deg = longitude_deg;
  trajectory.initial.height_m = 500.0;
  trajectory.initial.speed_m_per_s = 20.0;
  trajectory.initial.yaw_deg = 60.0;
  trajectory.segments = {tables::segment(60.0, {tables::sinusoid(MotionType::SineRate, 20.0, 4.0, Axis::Z),
                                                tables::sinusoid(MotionType::SineRate, 10.0, 3.0, Axis::X),
                                                tables::sinusoid(MotionType::SineAccel, 2.0, 5.0, Axis::X)})};
  return trajectory;
}

/// The same place, followed live: 20 ms of latency, states at 100 Hz.
inline scenario::Trajectory followed(const scenario::Trajectory& motion) {
  scenario::Trajectory trajectory;
  trajectory.source = scenario::TrajectorySource::VehicleState;
  trajectory.initial = motion.initial;
  trajectory.vehicle.nominal_rate_hz = kStateRate_hz;
  return trajectory;
}

/// What a dynamics simulator would send at that instant.
inline VehicleState state_of(const TruthState& truth) {
  VehicleState state;
  state.sequence_number = truth.header.sequence_number;
  state.sim_time_ns = truth.header.sim_time_ns;
  state.latitude_rad = truth.latitude_rad;
  state.longitude_rad = truth.longitude_rad;
  state.height_m = truth.height_m;
  state.v_n = truth.v_n;
  state.q_nv = truth.q_nv;
  const Vector3 omega_ie_n = nav::omega_ie_n(truth.latitude_rad);
  const Vector3 omega_en_n = nav::omega_en_n(position(truth), truth.v_n);
  state.omega_nv_v = truth.omega_iv_v - truth.q_nv.conjugate() * (omega_ie_n + omega_en_n);
  state.a_n =
      truth.q_nv * truth.f_v - (2.0 * omega_ie_n + omega_en_n).cross(truth.v_n) + nav::Gravity().g_n(position(truth));
  return state;
}

inline std::vector<TruthState> truth_of(const scenario::Trajectory& motion, double rate_hz, double seconds) {
  MotionTableModel model(motion, time::Rate(rate_hz), kStart);
  std::vector<TruthState> truth{model.current()};
  const auto steps = static_cast<std::size_t>(std::lround(seconds * rate_hz));
  while (truth.size() <= steps) truth.push_back(model.advance());
  return truth;
}

inline std::vector<VehicleState> states_of(const scenario::Trajectory& motion, double seconds,
                                           double rate_hz = kStateRate_hz) {
  std::vector<VehicleState> states;
  for (const TruthState& truth : truth_of(motion, rate_hz, seconds)) states.push_back(state_of(truth));
  states.erase(states.begin());  // the one at 0 is the initial state
  return states;
}

/// A state and when it arrives.
struct Arrival {
  VehicleState state;
  std::int64_t at_ns;
};

/// Every state `delay_ns` after its time, but those from `from_s` to `to_s`, which are lost.
inline std::vector<Arrival> arrivals_of(const std::vector<VehicleState>& states, std::int64_t delay_ns,
                                        double from_s = 0.0, double to_s = 0.0) {
  std::vector<Arrival> arrivals;
  for (const VehicleState& state : states) {
    const double t_s = time::to_seconds(state.sim_time_ns);
    if (t_s < from_s - 1e-9 || t_s > to_s + 1e-9) arrivals.push_back({state, state.sim_time_ns + delay_ns});
  }
  return arrivals;
}

/// Runs `model`; before each sample it is given what has arrived by the sample's time.
inline std::vector<TruthState> follow(LiveVehicleModel& model, const std::vector<Arrival>& arrivals, double seconds,
                                      double rate_hz = kTruthRate_hz) {
  const time::Rate rate(rate_hz);
  std::vector<TruthState> truth{model.current()};
  std::size_t next = 0;
  const auto steps = static_cast<std::size_t>(std::lround(seconds * rate_hz));
  while (truth.size() <= steps) {
    while (next < arrivals.size() && arrivals[next].at_ns <= rate.at(truth.size()).count()) {
      model.receive(arrivals[next++].state);
    }
    truth.push_back(model.advance());
  }
  return truth;
}

inline LiveVehicleModel model_of(const scenario::Trajectory& trajectory, double rate_hz = kTruthRate_hz) {
  return LiveVehicleModel(trajectory, scenario::uniform_gravity(trajectory.gravity), time::Rate(rate_hz), kStart);
}

}  // namespace inslab::trajectory::live_vehicle
