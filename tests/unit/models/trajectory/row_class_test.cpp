// Attitudes by vehicle class along the rows of a file that has none: the same laws as along waypoints.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/models/trajectory/waypoint_motion.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::trajectory {
namespace row_class_test {

scenario::LoadedScenario loaded(const std::string& file) {
  return scenario::load(std::string(INSLAB_SOURCE_DIR) + "/" + file);
}

std::vector<TruthState> run(const scenario::LoadedScenario& scenario) {
  const auto model = make_truth_model(scenario, {2446, 0});
  std::vector<TruthState> truth{model->current()};
  while (truth.size() < scenario.truth_samples) truth.push_back(model->advance());
  return truth;
}

std::vector<TruthState> run(const TrajectoryFile& file, const scenario::VehicleAttitude& attitude, double rate_hz) {
  SmoothModel model(motion_through(file, attitude), "row", nav::Gravity(), time::Rate(rate_hz), {2300, 0});
  std::vector<TruthState> truth{model.current()};
  while (time::Rate(rate_hz).at(truth.size()) <= file.rows.back().time) truth.push_back(model.advance());
  return truth;
}

/// Rows at a distance in time, in metres north and east of 56 N 12 E, 30 m high.
template <class NorthEastAt>
TrajectoryFile rows(int count, double apart_s, NorthEastAt north_east_m) {
  TrajectoryFile file;
  file.name = "rows";
  const nav::Geodetic start{56.0 * units::kDeg, 12.0 * units::kDeg, 30.0};
  for (int k = 0; k < count; ++k) {
    const auto [north_m, east_m] = north_east_m(k * apart_s);
    nav::Geodetic here = nav::displaced(start, {north_m, east_m, 0.0});
    here.height_m = 30.0;
    file.rows.push_back({time::from_seconds(k * apart_s), here, {}, {}});
  }
  return file;
}

double seconds(const TruthState& truth) { return time::to_seconds(truth.header.sim_time_ns); }
nav::RollPitchYaw rpy(const TruthState& truth) { return nav::rpy_from_quaternion(truth.q_nv); }

scenario::VehicleAttitude of_class(scenario::VehicleClass vehicle_class) {
  scenario::VehicleAttitude attitude;
  attitude.vehicle_class = vehicle_class;
  return attitude;
}

TEST(RowsOfAMultirotor, LeanItByItsThrustAsTheWaypointsThatTheyAreOfDo) {
  // delivery_drone.json from 50 s on, when it leaves its hover: positions alone at 5 Hz, to 0.01 mm.
  const scenario::LoadedScenario of_rows = loaded("tests/data/drone_rows.json");
  const auto truth = run(of_rows);
  scenario::LoadedScenario of_waypoints = loaded("config/scenarios/delivery_drone.json");
  of_waypoints.truth_rate = of_rows.truth_rate;
  const std::size_t before = of_rows.truth_rate.index(time::from_seconds(50.0));
  of_waypoints.truth_samples = before + of_rows.truth_samples;
  of_waypoints.imus.clear();
  of_waypoints.gnss.clear();
  const auto reference = run(of_waypoints);
  const double drag_per_s = of_rows.scenario.trajectory.file.attitude_from_path.drag_per_s;
  double off_axis_m_per_s2 = 0.0, off_reference_rad = 0.0, tilt_rad = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vector3 thrust = truth[i].f_v + drag_per_s * (truth[i].q_nv.conjugate() * truth[i].v_n);
    ASSERT_LT(thrust.z(), -5.0);
    const nav::Matrix3 C = nav::matrix_from_quaternion(truth[i].q_nv);
    const nav::Matrix3 C_reference = nav::matrix_from_quaternion(reference[before + i].q_nv);
    // The first piece is a parabola, whose jerk jumps; from 35.2 s on it brakes from 13 to 10 m/s within 2.8 s.
    if (seconds(truth[i]) > 1.0 && seconds(truth[i]) < 34.5) {
      off_axis_m_per_s2 = std::max(off_axis_m_per_s2, std::hypot(thrust.x(), thrust.y()));
      off_reference_rad = std::max(off_reference_rad, (C.col(2) - C_reference.col(2)).norm());
    }
    tilt_rad = std::max(tilt_rad, std::acos(C(2, 2)));
    EXPECT_NEAR(rpy(truth[i]).yaw_rad, 66.0 * units::kDeg, 1e-3) << i;
  }
  RecordProperty("off_axis_m_per_s2", std::to_string(off_axis_m_per_s2));
  RecordProperty("off_reference_rad", std::to_string(off_reference_rad));
  // Where the curve's jerk jumps by J at a row the law's rate jumps by J/g, and a smooth curve through attitudes 0.2 s
  // apart swings by a tenth of that times 0.2 s, of g: 0.02 s J. J is the ramp's 0.43 m/s^4 times 0.2 s and 60 times
  // the rounding, 0.5e-5 m, over (0.2 s)^3.
  EXPECT_LT(off_axis_m_per_s2, 0.02 * (0.086 + 0.038));
  // A cubic through positions 0.2 s apart errs by h^2/12 of the fourth derivative in its second, 1.4e-3 m/s^2, and the
  // rounding of a row does up to 6/h^2 of it, 8e-4 m/s^2; both over g, and the swing.
  EXPECT_LT(off_reference_rad, 5e-4);
  EXPECT_GT(tilt_rad, 10.0 * units::kDeg);
}

TEST(RowsOfAMultirotor, AreRefusedWhereTheyLeanItTooFar) {
  scenario::LoadedScenario scenario = loaded("tests/data/drone_rows.json");
  scenario.scenario.trajectory.file.attitude_from_path.max_tilt_deg = 8.0;
  try {
    make_truth_model(scenario, {2446, 0});
    FAIL() << "was accepted";
  } catch (const json::Error& error) {
    EXPECT_EQ(error.path(), "trajectory.file.attitude_from_path");
    EXPECT_NE(std::string(error.what()).find("leads into a tilt of 8."), std::string::npos) << error.what();
  }
}

/// 40 s at the quay, then north-east ever faster, and 20 s ahead at 7 m/s.
TrajectoryFile ferry_rows() {
  return rows(101, 1.0, [](double t_s) {
    const double under_way_s = std::max(0.0, t_s - 40.0), steady_s = std::max(0.0, under_way_s - 40.0);
    const double ramp_s = under_way_s - steady_s;
    // Speed 7 (1 - cos(pi t/40))/2, then 7.
    const double way_m = 3.5 * (ramp_s - 40.0 / units::kPi * std::sin(units::kPi * ramp_s / 40.0)) + 7.0 * steady_s;
    return std::pair(way_m * std::cos(0.7), way_m * std::sin(0.7));
  });
}

TEST(RowsOfAShip, RollPitchAndHeaveAtTheQuayTooWithTheNoseOnTheCourseToCome) {
  scenario::VehicleAttitude ship = of_class(scenario::VehicleClass::Ship);
  ship.roll_amplitude_deg = 3.0, ship.roll_period_s = 9.0;
  ship.pitch_amplitude_deg = 1.0, ship.pitch_period_s = 5.0;
  ship.heave_amplitude_m = 0.8, ship.heave_period_s = 7.0;
  const auto truth = run(ferry_rows(), ship, 20.0);
  const auto wave = [](const TruthState& sample, double amplitude, double period_s) {
    return amplitude * std::sin(2.0 * units::kPi * seconds(sample) / period_s);
  };
  for (const TruthState& sample : truth) {
    // As of the ferry along waypoints, with amplitudes five times as large.
    ASSERT_NEAR(rpy(sample).roll_rad, wave(sample, 3.0 * units::kDeg, 9.0), 2.5e-5) << seconds(sample);
    ASSERT_NEAR(rpy(sample).pitch_rad, wave(sample, 1.0 * units::kDeg, 5.0), 2.5e-5) << seconds(sample);
    // North-east is 0.7 rad at the start and the meridian converges by 1e-4 rad on the way.
    ASSERT_NEAR(rpy(sample).yaw_rad, 0.7, 3e-4) << seconds(sample);
    // The curve between rows at one height sags under it by the arc over its chord: (7 m)^2/(8 R).
    ASSERT_NEAR(sample.height_m, 30.0 + wave(sample, 0.8, 7.0), 2e-6) << seconds(sample);
  }
  EXPECT_EQ(truth.front().latitude_rad, truth[700].latitude_rad) << "lies at the quay";
}

TEST(RowsOfAShip, TurnItToTheNewCourseWhileItGathersWay) {
  // Twenty seconds north while it brakes from 3 m/s, twenty at rest, then east.
  const auto braked_m = [](double t_s) { return 1.5 * (t_s + 20.0 / units::kPi * std::sin(units::kPi * t_s / 20.0)); };
  const auto file = rows(81, 1.0, [&](double t_s) {
    const double under_way_s = std::clamp(t_s - 40.0, 0.0, 20.0), steady_s = std::max(0.0, t_s - 60.0);
    return std::pair(braked_m(std::min(t_s, 20.0)), 30.0 - braked_m(20.0 - under_way_s) + 3.0 * steady_s);
  });
  const auto truth = run(file, of_class(scenario::VehicleClass::Ship), 20.0);
  for (const TruthState& sample : truth) {
    const double t_s = seconds(sample), off_north_rad = nav::wrapped_to_pi(rpy(sample).yaw_rad);
    // 0.3 m/s are reached at 16.1 s and again at 44.1 s: from row 44 to row 45 it turns by 90 deg.
    if (t_s < 43.9) {
      ASSERT_NEAR(off_north_rad, 0.0, 1e-3) << t_s;
    }
    if (t_s > 45.1) {
      ASSERT_NEAR(off_north_rad, 90.0 * units::kDeg, 1e-3) << t_s;
    }
    // 15/8 of the mean rate.
    ASSERT_LT(sample.omega_iv_v.norm(), 1.1 * 15.0 / 8.0 * 90.0 * units::kDeg) << t_s;
  }
}

TEST(RowsOfAShip, DoNotTurnItWhereTheyStopAtOnce) {
  // North at 1 m/s, then at rest. The curve rings: 0.5 m/s at the last row of the way, 0.13 m/s back at the next.
  const auto file = rows(41, 1.0, [](double t_s) { return std::pair(std::min(t_s, 20.0), 0.0); });
  for (const TruthState& sample : run(file, of_class(scenario::VehicleClass::Ship), 20.0)) {
    ASSERT_NEAR(nav::wrapped_to_pi(rpy(sample).yaw_rad), 0.0, 1e-6) << seconds(sample);
  }
}

TEST(RowsOfAFixedWing, BankUntilNothingPullsSideways) {
  // A circle of 2 deg/s at 60 m/s.
  const double rate = 2.0 * units::kDeg, radius_m = 60.0 / rate;
  const auto file = rows(360, 0.5, [&](double t_s) {
    return std::pair(radius_m * std::sin(rate * t_s), -radius_m * std::cos(rate * t_s));
  });
  scenario::VehicleAttitude aircraft = of_class(scenario::VehicleClass::FixedWing);
  aircraft.max_bank_deg = 45.0, aircraft.angle_of_attack_deg = 3.0;
  const auto truth = run(file, aircraft, 20.0);
  for (const TruthState& sample : truth) {
    if (seconds(sample) < 3.0 || seconds(sample) > 176.0) continue;  // the end pieces are parabolas
    ASSERT_NEAR(sample.f_v.y(), 0.0, 5e-4 * 12.0) << seconds(sample);
    ASSERT_NEAR(rpy(sample).roll_rad, std::atan(60.0 * rate / 9.80665), 3e-3) << seconds(sample);
  }
}

TEST(RowsOfAShip, AreRefusedWhereItWouldTurnOnTheSpot) {
  // Back and forth at speed, without a row at standstill.
  const auto file = rows(40, 1.0, [](double t_s) { return std::pair(std::abs(5.0 * (t_s - 19.5)), 0.0); });
  try {
    motion_through(file, of_class(scenario::VehicleClass::Ship));
    FAIL() << "was accepted";
  } catch (const std::domain_error& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.find("rows: the nose turns by"), 0U) << what;
    EXPECT_NE(what.find("on the way from row 19"), std::string::npos) << what;
  }
}

TEST(RowsWithAttitude, KeepItWhateverTheClass) {
  TrajectoryFile file = ferry_rows();
  for (TrajectoryRow& row : file.rows) row.rpy = nav::RollPitchYaw{0.1, 0.05, 2.0};
  scenario::VehicleAttitude ship = of_class(scenario::VehicleClass::Ship);
  ship.heave_amplitude_m = 1.0;
  const auto as_ship = run(file, ship, 20.0), as_any = run(file, {}, 20.0);
  for (std::size_t i = 0; i < as_ship.size(); ++i) {
    ASSERT_EQ(as_ship[i].q_nv.coeffs(), as_any[i].q_nv.coeffs());
    ASSERT_EQ(as_ship[i].height_m, as_any[i].height_m);
  }
}

}  // namespace row_class_test
}  // namespace inslab::trajectory
