// The truth along curves against itself: what is published as a derivative or an integral is one of what else is.

#include "inslab/models/trajectory/smooth_vehicle.hpp"

#include <gtest/gtest.h>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"
#include "tests/unit/models/trajectory/rows.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace smooth_vehicle_test {

constexpr double kPlace_m = 2.9e-9;

std::vector<TruthState> run(const TrajectoryFile& file, double rate_hz) {
  SmoothModel model(motion_through(file, {}), "row", nav::Gravity(), time::Rate(rate_hz), {2300, 0});
  std::vector<TruthState> truth{model.current()};
  const time::Rate rate(rate_hz);
  while (rate.at(truth.size()) <= file.rows.back().time) truth.push_back(model.advance());
  return truth;
}

/// The table moved to another place.
scenario::Trajectory moved(scenario::Trajectory table, double latitude_deg, double longitude_deg) {
  table.initial.latitude_deg = latitude_deg;
  table.initial.longitude_deg = longitude_deg;
  return table;
}

struct Case {
  const char* name;
  TrajectoryFile (*file)();
};

class SmoothTruth : public testing::TestWithParam<Case> {};

TEST_P(SmoothTruth, DoesNotDependOnTheGridNorItsIncrementsOnTheSteps) {
  // Steps of 5 ms, and of 1 ms: what Gauss's rule leaves of a step falls to (1/5)^6.
  const auto coarse = run(GetParam().file(), 200.0);
  const auto fine = run(GetParam().file(), 1000.0);
  for (std::size_t i = 1; i < coarse.size(); ++i) {
    ASSERT_LT(nav::ned_from(geodetic_of(coarse[i]), geodetic_of(fine[5 * i])).norm(), kPlace_m) << i;
    ASSERT_LT((coarse[i].v_n - fine[5 * i].v_n).norm(), 1e-12) << i;
    ASSERT_LT(nav::angle_between(coarse[i].q_nv, fine[5 * i].q_nv), 2e-15) << i;
    Vector3 dtheta = Vector3::Zero(), dv = Vector3::Zero();
    for (std::size_t j = 5 * i - 4; j <= 5 * i; ++j) {
      dtheta += fine[j].dtheta_v;
      dv += fine[j].dv_v;
    }
    // 1e-12 of an increment under 1 g and at 0.5 rad/s.
    ASSERT_LT((dtheta - coarse[i].dtheta_v).norm(), 2.5e-15) << i;
    ASSERT_LT((dv - coarse[i].dv_v).norm(), 5e-14) << i;
  }
}

TEST_P(SmoothTruth, VelocityIsTheDerivativeOfThePosition) {
  const auto truth = run(GetParam().file(), 1000.0);
  for (std::size_t i = 2; i + 2 < truth.size(); ++i) {
    // Five points 1 ms apart: places are good to 3e-9 m, and h^4/30 of the fifth derivative is less.
    const nav::Geodetic here = geodetic_of(truth[i]);
    const auto way = [&](std::size_t j) { return nav::ned_from(here, geodetic_of(truth[j])); };
    const Vector3 velocity = (8.0 * (way(i + 1) - way(i - 1)) - (way(i + 2) - way(i - 2))) / 12e-3;
    ASSERT_LT((velocity - truth[i].v_n).norm(), 6e-6) << i;
  }
}

TEST_P(SmoothTruth, AttitudeChangesAsTheIncrementsOfAngleSay) {
  const auto truth = run(GetParam().file(), 1000.0);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Vector3 omega_in_n =
        nav::omega_ie_n(truth[i].latitude_rad) + nav::omega_en_n(geodetic_of(truth[i]), truth[i].v_n);
    const Quaternion q = nav::quaternion_from_rotation_vector(-omega_in_n * 1e-3) * truth[i - 1].q_nv *
                         nav::quaternion_from_rotation_vector(truth[i].dtheta_v);
    // Coning within 1 ms, omega x omega'/12 h^3, of some 0.3 rad/s and 3 rad/s^2.
    ASSERT_LT(nav::angle_between(q, truth[i].q_nv), 1e-10) << i;
  }
}

TEST_P(SmoothTruth, VelocityChangesAsTheIncrementsOfSpecificForceSay) {
  // v_n' = C_nv f_v - (2 omega_ie_n + omega_en_n) x v_n + g_n over the 1 ms before and the 1 ms after an instant, each
  // dv_v turned from its middle to the instant's axes. What is left is h^3/3 of omega^2 f: 3e-9 m/s at 1 rad/s.
  const auto truth = run(GetParam().file(), 1000.0);
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    const TruthState &here = truth[i], &after = truth[i + 1];
    const Vector3 omega_ie_n = nav::omega_ie_n(here.latitude_rad);
    const Vector3 omega_en_n = nav::omega_en_n(geodetic_of(here), here.v_n);
    const Vector3 rest_n = nav::Gravity().g_n(geodetic_of(here)) - (2.0 * omega_ie_n + omega_en_n).cross(here.v_n);
    const Vector3 dv_v = here.dv_v - 0.5 * here.dtheta_v.cross(here.dv_v) +  //
                         after.dv_v + 0.5 * after.dtheta_v.cross(after.dv_v);
    const Vector3 change_n = nav::matrix_from_quaternion(here.q_nv) * dv_v + 2e-3 * rest_n;
    ASSERT_LT((after.v_n - truth[i - 1].v_n - change_n).norm(), 3e-9) << i;
  }
}

TEST_P(SmoothTruth, QuaternionsAreCanonical) {
  for (const TruthState& truth : run(GetParam().file(), 200.0)) {
    ASSERT_GE(truth.q_nv.w(), 0.0);
    ASSERT_NEAR(truth.q_nv.norm(), 1.0, 4e-16);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Files, SmoothTruth,
    testing::Values(Case{"VehicleAt10Hz", [] { return rows::of_table(tables::vehicle(), 10.0, 350.0); }},
                    Case{"AircraftAt1HzOverTheAntimeridian",
                         [] { return rows::of_table(moved(tables::aircraft(), -17.0, 179.9), 1.0, 330.0); }},
                    Case{"ShipAt10HzInTheWest",
                         [] { return rows::of_table(moved(tables::ship(), 70.0, -120.0), 10.0, 100.0); }},
                    Case{"PositionsAloneAt10Hz",
                         [] { return rows::positions_of(rows::of_table(tables::aircraft(), 10.0, 300.0)); }}),
    [](const auto& file) { return file.param.name; });

}  // namespace smooth_vehicle_test
}  // namespace inslab::trajectory
