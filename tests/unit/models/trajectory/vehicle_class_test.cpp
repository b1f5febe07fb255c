// Attitudes by vehicle class: each class against its own law, and the published truth against an independent
// integration in ECEF.

#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "inslab/data/json/config_error.hpp"
#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/models/trajectory/waypoint_motion.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::trajectory {
namespace vehicle_class_test {

scenario::LoadedScenario shipped(const std::string& name) {
  return scenario::load(std::filesystem::path(INSLAB_SOURCE_DIR) / "config" / "scenarios" / (name + ".json"));
}

/// An aeroplane that takes off, turns both ways while it climbs, and flies on.
scenario::LoadedScenario aeroplane() {
  scenario::LoadedScenario loaded = shipped("ferry");
  scenario::Trajectory& trajectory = loaded.scenario.trajectory;
  trajectory = {};
  trajectory.source = scenario::TrajectorySource::Waypoints;
  trajectory.attitude_from_path.vehicle_class = scenario::VehicleClass::FixedWing;
  trajectory.attitude_from_path.max_bank_deg = 60.0;
  trajectory.attitude_from_path.angle_of_attack_deg = 4.0;
  trajectory.attitude_from_path.lift_off_speed_m_per_s = 30.0;
  trajectory.waypoints = {{-33.0, 151.0, 10.0, 0.0, 10.0}, {-33.0, 151.008, 10.0, 36.0},
                          {-33.0, 151.03, 150.0, 55.0},    {-33.01, 151.05, 350.0, 60.0},
                          {-33.03, 151.06, 500.0, 60.0},   {-33.035, 151.09, 500.0, 60.0}};
  loaded.scenario.duration_s = 170.0;
  loaded.truth_samples = 170 * 200 + 1;
  return loaded;
}

std::vector<TruthState> run(scenario::LoadedScenario loaded, double rate_hz) {
  loaded.truth_rate = time::Rate(rate_hz);
  loaded.imus.clear();
  loaded.gnss.clear();
  loaded.truth_samples = static_cast<std::uint64_t>(loaded.scenario.duration_s * rate_hz) + 1;
  const auto model = make_truth_model(loaded, {2446, 0});
  std::vector<TruthState> truth{model->current()};
  const time::Nanoseconds end = time::from_seconds(loaded.scenario.duration_s);
  while (time::Rate(rate_hz).at(truth.size()) <= end) truth.push_back(model->advance());
  return truth;
}

nav::RollPitchYaw rpy(const TruthState& truth) { return nav::rpy_from_quaternion(truth.q_nv); }
double seconds(const TruthState& truth) { return time::to_seconds(truth.header.sim_time_ns); }

struct Case {
  const char* name;
  scenario::LoadedScenario (*load)();
};
scenario::LoadedScenario drone() { return shipped("delivery_drone"); }
scenario::LoadedScenario ferry() { return shipped("ferry"); }
scenario::LoadedScenario car() { return shipped("car_tunnel"); }
/// The ferry in a swell.
scenario::LoadedScenario swell() {
  scenario::LoadedScenario loaded = ferry();
  loaded.scenario.trajectory.attitude_from_path.heave_amplitude_m = 2.0;
  loaded.scenario.trajectory.attitude_from_path.heave_period_s = 7.0;
  return loaded;
}
/// A drone along the rows of a file without attitudes.
scenario::LoadedScenario rows() {
  return scenario::load(std::filesystem::path(INSLAB_SOURCE_DIR) / "tests" / "data" / "drone_rows.json");
}

class VehicleClasses : public testing::TestWithParam<Case> {};

TEST_P(VehicleClasses, PublishDerivativesThatAreThose) {
  const nav::Gravity gravity(nav::GravityModel::Normal);
  const auto truth = run(GetParam().load(), 200.0);
  double worst_v = 0.0, worst_f = 0.0, worst_rate = 0.0;
  for (std::size_t i = 2; i + 2 < truth.size(); ++i) {
    const TruthState& here = truth[i];
    const auto derivative = [&](auto value) -> Vector3 {
      return (8.0 * (value(truth[i + 1]) - value(truth[i - 1])) - (value(truth[i + 2]) - value(truth[i - 2]))) / 60e-3;
    };
    const Vector3 v = derivative([&](const TruthState& t) { return nav::ned_from(geodetic_of(here), geodetic_of(t)); });
    const Vector3 omega_ie_n = nav::omega_ie_n(here.latitude_rad);
    const Vector3 omega_en_n = nav::omega_en_n(geodetic_of(here), here.v_n);
    const Vector3 a_n = derivative([](const TruthState& t) { return t.v_n; });
    const Vector3 f_v = here.q_nv.conjugate() *
                        (a_n + (2.0 * omega_ie_n + omega_en_n).cross(here.v_n) - gravity.g_n(geodetic_of(here)));
    const Vector3 turn = derivative([&](const TruthState& t) -> Vector3 {
      return nav::rotation_vector_from_quaternion(here.q_nv.conjugate() * t.q_nv);
    });
    const Vector3 omega_iv_v = turn + here.q_nv.conjugate() * (omega_ie_n + omega_en_n);
    worst_v = std::max(worst_v, (v - here.v_n).norm());
    worst_f = std::max(worst_f, (f_v - here.f_v).norm());
    worst_rate = std::max(worst_rate, (omega_iv_v - here.omega_iv_v).norm());
  }
  // Where a joint lies among the five samples the jerk may jump by up to some 1 m/s^3, the angular jerk by 10 rad/s^3:
  // (5 ms)^2/10 of them. The rounding of a longitude, 1.4e-9 m, over 5 ms is 4e-7 m/s.
  EXPECT_LT(worst_v, 2e-6);
  EXPECT_LT(worst_f, 5e-3);
  EXPECT_LT(worst_rate, 2e-4);
}

TEST_P(VehicleClasses, TurnAsTheIncrementsOfAngleSay) {
  // Coning over 5 ms: (rate * dt)(angular acceleration * dt^2)/12, 1 rad/s and 10 rad/s^2: 1e-7 rad.
  const auto truth = run(GetParam().load(), 200.0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Vector3 omega_in_n =
        nav::omega_ie_n(truth[i].latitude_rad) + nav::omega_en_n(geodetic_of(truth[i]), truth[i].v_n);
    const Quaternion q = nav::quaternion_from_rotation_vector(-omega_in_n * 5e-3) * truth[i - 1].q_nv *
                         nav::quaternion_from_rotation_vector(truth[i].dtheta_v);
    ASSERT_LT(nav::angle_between(q, truth[i].q_nv), 1e-7) << i;
  }
}

TEST_P(VehicleClasses, NeverTurnFasterThanAVehicleDoes) {
  for (const TruthState& sample : run(GetParam().load(), 50.0)) {
    ASSERT_LT(sample.omega_iv_v.norm(), 60.0 * units::kDeg) << seconds(sample);
  }
}

/// Displacement from the start and velocity in e, and q_ev.
using EcefState = std::array<long double, 10>;

/// The published rate and force, integrated by Boost.Odeint in ECEF from the published start: steps of two samples,
/// whose middle is the third point that Runge and Kutta need.
TEST_P(VehicleClasses, MoveAsAnIndependentIntegrationOfTheirRateAndForce) {
  using LongVector = Eigen::Matrix<long double, 3, 1>;
  using LongQuaternion = Eigen::Quaternion<long double>;
  const nav::Gravity gravity(nav::GravityModel::Normal);
  const scenario::LoadedScenario loaded = GetParam().load();
  // Joints of the jerk lie inside steps and cost h^2/24 of its jump each, 1e-7 m/s for 1 m/s^3 and 1.25 ms.
  const double rate_hz = loaded.scenario.duration_s < 500.0 ? 1600.0 : 400.0;
  const long double step_s = 2.0L / rate_hz;  // the rates are by the step
  const auto truth = run(loaded, rate_hz);
  const nav::Vector3 start_e = nav::ecef_from_geodetic(geodetic_of(truth.front()));
  const auto C_en_at = [](const nav::Geodetic& p) { return nav::C_en(p.latitude_rad, p.longitude_rad); };
  const LongVector omega_ie_e(0.0L, 0.0L, nav::wgs84::omega_e_rad_per_s);

  EcefState state{};
  const nav::Matrix3 C_en = C_en_at(geodetic_of(truth.front()));
  const Eigen::Quaterniond q_start = nav::quaternion_from_matrix(C_en) * truth.front().q_nv;
  for (int i = 0; i < 3; ++i) state[3 + i] = (C_en * truth.front().v_n)[i];
  state[6] = q_start.w(), state[7] = q_start.x(), state[8] = q_start.y(), state[9] = q_start.z();

  std::size_t sample = 0;  // at the step's start
  const auto system = [&](const EcefState& x, EcefState& rate, long double t) {
    const auto half = static_cast<std::size_t>(std::lround(static_cast<double>(t) * 2.0));
    const TruthState& now = truth[sample + half];
    const LongVector r(x[0], x[1], x[2]), v(x[3], x[4], x[5]);
    const LongQuaternion q(x[6], x[7], x[8], x[9]);
    const nav::Geodetic place = nav::geodetic_from_ecef(start_e + r.cast<double>());
    const LongVector g_e = (C_en_at(place) * gravity.g_n(place)).cast<long double>();
    const LongVector a = q.normalized() * now.f_v.cast<long double>().eval() + g_e - 2.0L * omega_ie_e.cross(v);
    const LongVector omega = now.omega_iv_v.cast<long double>() - q.normalized().conjugate() * omega_ie_e;
    const LongQuaternion dq = q * LongQuaternion(0.0L, omega.x() / 2, omega.y() / 2, omega.z() / 2);
    rate = {step_s * v.x(), step_s * v.y(),  step_s * v.z(),  step_s * a.x(),  step_s * a.y(),
            step_s * a.z(), step_s * dq.w(), step_s * dq.x(), step_s * dq.y(), step_s * dq.z()};
  };
  boost::numeric::odeint::runge_kutta4<EcefState, long double> stepper;
  double position_m = 0.0, velocity_m_per_s = 0.0, attitude_rad = 0.0;
  while (sample + 2 < truth.size()) {
    stepper.do_step(system, state, 0.0L, 1.0L);
    sample += 2;
    if (sample % 400 != 0) continue;
    const TruthState& now = truth[sample];
    const nav::Matrix3 C = C_en_at(geodetic_of(now));
    const nav::Vector3 r(static_cast<double>(state[0]), static_cast<double>(state[1]), static_cast<double>(state[2]));
    const nav::Vector3 v(static_cast<double>(state[3]), static_cast<double>(state[4]), static_cast<double>(state[5]));
    const Eigen::Quaterniond q(static_cast<double>(state[6]), static_cast<double>(state[7]),
                               static_cast<double>(state[8]), static_cast<double>(state[9]));
    position_m = std::max(position_m, (start_e + r - nav::ecef_from_geodetic(geodetic_of(now))).norm());
    velocity_m_per_s = std::max(velocity_m_per_s, (v - C * now.v_n).norm());
    attitude_rad =
        std::max(attitude_rad, nav::angle_between(q.normalized(), nav::quaternion_from_matrix(C) * now.q_nv));
  }
  RecordProperty("position_m", std::to_string(position_m));
  EXPECT_LT(position_m, 1e-3);
  EXPECT_LT(velocity_m_per_s, 1e-5);
  EXPECT_LT(attitude_rad, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, VehicleClasses,
                         testing::Values(Case{"drone", drone}, Case{"ferry", ferry}, Case{"car", car},
                                         Case{"swell", swell}, Case{"aeroplane", aeroplane}, Case{"rows", rows}),
                         [](const auto& one) { return one.param.name; });

TEST(Multirotor, FeelsItsThrustAlongMinusZAndNothingElseButDrag) {
  const scenario::LoadedScenario loaded = drone();
  const double drag_per_s = loaded.scenario.trajectory.attitude_from_path.drag_per_s;
  double tilt_rad = 0.0, off_axis_m_per_s2 = 0.0;
  for (const TruthState& sample : run(loaded, 100.0)) {
    const Vector3 thrust = sample.f_v + drag_per_s * (sample.q_nv.conjugate() * sample.v_n);
    ASSERT_LT(thrust.z(), -5.0);
    off_axis_m_per_s2 = std::max(off_axis_m_per_s2, std::hypot(thrust.x(), thrust.y()));
    tilt_rad = std::max(tilt_rad, std::acos(nav::matrix_from_quaternion(sample.q_nv)(2, 2)));
  }
  // Where it is probed the arc between two attitudes leaves the law by 2e-5 rad at most, of 12 m/s^2. At the ends of a
  // ramp the law's angular acceleration jumps, by 0.5 rad/s^2, from where on the arc over h leaves it by 0.5 h^2/8: h
  // is 0.018 s there. The spline swings beside it by about as much again, and in intervals that grow by no more than
  // two.
  RecordProperty("off_axis_m_per_s2", std::to_string(off_axis_m_per_s2));
  EXPECT_LT(off_axis_m_per_s2, 5e-5 * 12.0);
  EXPECT_GT(tilt_rad, 12.0 * units::kDeg);
  EXPECT_LT(tilt_rad, 30.0 * units::kDeg);
}

TEST(Multirotor, StandsLevelOnItsPadAndHoldsItsPlacesAndYaws) {
  const scenario::LoadedScenario loaded = drone();
  const auto& waypoints = loaded.scenario.trajectory.waypoints;
  const auto truth = run(loaded, 100.0);
  std::size_t i = 0;
  double yaw_rad = 0.0;
  for (std::size_t k = 0; k < waypoints.size(); ++k) {
    const scenario::Waypoint& waypoint = waypoints[k];
    if (waypoint.yaw_deg) yaw_rad = *waypoint.yaw_deg * units::kDeg;
    if (waypoint.wait_s == 0.0) continue;
    // The end of the wait, where the yaw has arrived.
    const nav::Geodetic place{waypoint.latitude_deg * units::kDeg, waypoint.longitude_deg * units::kDeg,
                              waypoint.height_m};
    const auto here = [&] { return truth[i].v_n.norm() == 0.0 && truth[i].segment_index == k; };
    while (i < truth.size() && !here()) ++i;
    ASSERT_LT(i, truth.size()) << "never stood at waypoint " << k;
    const double from_s = seconds(truth[i]);
    while (i + 1 < truth.size() && truth[i + 1].segment_index == k && truth[i + 1].v_n.norm() == 0.0) ++i;
    if (k + 1 < waypoints.size()) {
      EXPECT_NEAR(seconds(truth[i]) - from_s, waypoint.wait_s, 0.011) << k;
    }
    EXPECT_LT(nav::ned_from(place, geodetic_of(truth[i])).norm(), 1e-8) << k;
    EXPECT_NEAR(rpy(truth[i]).roll_rad, 0.0, 1e-5) << k;
    EXPECT_NEAR(rpy(truth[i]).pitch_rad, 0.0, 1e-5) << k;
    EXPECT_NEAR(nav::wrapped_to_pi(rpy(truth[i]).yaw_rad - yaw_rad), 0.0, 1e-5) << k;
  }
}

TEST(Multirotor, GoesFromStopToStopWithoutAStep) {
  const auto truth = run(drone(), 200.0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    // A ramp to 4 m/s at 2 m/s^2 has a jerk of 5.77 dv/T^2 = 1.64 m/s^3, in 5 ms 8.2e-3 m/s^2, and turns of 0.6 rad/s
    // swing 12 m/s^2 by 0.036; angular accelerations stay below 2 rad/s^2.
    ASSERT_LT((truth[i].f_v - truth[i - 1].f_v).norm(), 0.05) << i;
    ASSERT_LT((truth[i].omega_iv_v - truth[i - 1].omega_iv_v).norm(), 1e-2) << i;
  }
}

TEST(Ship, LiesAtTheQuayRollingAndKeepsItsNoseOnTheTrack) {
  const scenario::LoadedScenario loaded = ferry();
  const scenario::VehicleAttitude& sea = loaded.scenario.trajectory.attitude_from_path;
  for (const TruthState& sample : run(loaded, 20.0)) {
    const auto wave = [&](double amplitude_deg, double period_s) {
      return amplitude_deg * units::kDeg * std::sin(2.0 * 3.14159265358979323846 * seconds(sample) / period_s);
    };
    // Cubics between 64 points of a period leave (2 pi/64)^4/384 of the amplitude; at the run's end, where the spline's
    // angular acceleration is 0 and the pitch's is not, h^2/12 of 0.0045 rad/s^2 with h = 0.086 s: 3e-6 rad.
    ASSERT_NEAR(rpy(sample).roll_rad, wave(sea.roll_amplitude_deg, sea.roll_period_s), 5e-6) << seconds(sample);
    ASSERT_NEAR(rpy(sample).pitch_rad, wave(sea.pitch_amplitude_deg, sea.pitch_period_s), 5e-6) << seconds(sample);
    if (sample.v_n.norm() < 0.01) continue;
    const double course_rad = std::atan2(sample.v_n.y(), sample.v_n.x());
    ASSERT_NEAR(nav::wrapped_to_pi(rpy(sample).yaw_rad - course_rad), 0.0, 1e-4) << seconds(sample);
  }
}

TEST(FixedWing, FeelsNoSideForceInTheAirAndKeepsItsWingsLevelOnTheGround) {
  double bank_rad = 0.0, side_m_per_s2 = 0.0;
  for (const TruthState& sample : run(aeroplane(), 50.0)) {
    if (sample.v_n.norm() < 30.0) {
      ASSERT_NEAR(rpy(sample).roll_rad, 0.0, 1e-4) << seconds(sample);
    }
    if (sample.v_n.norm() < 1.25 * 30.0) continue;
    side_m_per_s2 = std::max(side_m_per_s2, std::abs(sample.f_v.y()));
    bank_rad = std::max(bank_rad, std::abs(rpy(sample).roll_rad));
    const double climb_rad = std::asin(-sample.v_n.z() / sample.v_n.norm());
    // The angle of attack lies in the banked plane, so pitch is below the sum of both.
    ASSERT_LT(rpy(sample).pitch_rad, climb_rad + 4.0 * units::kDeg + 1e-3);
    ASSERT_GT(rpy(sample).pitch_rad, climb_rad + 4.0 * units::kDeg * std::cos(rpy(sample).roll_rad) - 5e-3);
  }
  EXPECT_LT(side_m_per_s2, 5e-4 * 12.0);
  EXPECT_GT(bank_rad, 10.0 * units::kDeg);
  EXPECT_LT(bank_rad, 59.0 * units::kDeg) << "or the limit would have cut it";
}

TEST(NoseAlongTrack, IsRefusedWhereADroneLeavesItsPad) {
  scenario::LoadedScenario loaded = drone();
  scenario::Trajectory& trajectory = loaded.scenario.trajectory;
  trajectory.attitude_from_path = {};
  trajectory.max_acceleration_m_per_s2 = 1000.0;
  trajectory.waypoints = {{47.38, 8.54, 455.0, 0.0, 30.0}, {47.38, 8.54, 495.0, 4.0}, {47.3815, 8.545, 505.0, 10.0}};
  loaded.truth_samples = 100;
  try {
    make_truth_model(loaded, {2446, 0});
    FAIL() << "was accepted";
  } catch (const json::Error& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("turns by"), std::string::npos) << what;
    EXPECT_NE(what.find("vehicle_class multirotor"), std::string::npos) << what;
  }
}

}  // namespace vehicle_class_test
}  // namespace inslab::trajectory
