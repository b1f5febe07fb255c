#include "inslab/models/trajectory/row_motion.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "tests/unit/models/trajectory/rows.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace row_motion_test {

// Half a unit in the last place of a longitude of 3 rad, in metres on the equator.
constexpr double kPlace_m = 2.9e-9;

SmoothModel model_of(const TrajectoryFile& file, double rate_hz) {
  return {motion_through(file, {}), "row", nav::Gravity(), time::Rate(rate_hz), {2300, 0}};
}

std::vector<TruthState> run(const TrajectoryFile& file, double rate_hz) {
  SmoothModel model = model_of(file, rate_hz);
  std::vector<TruthState> truth{model.current()};
  const time::Rate rate(rate_hz);
  while (rate.at(truth.size()) <= file.rows.back().time) truth.push_back(model.advance());
  return truth;
}

/// A straight way east from 30 N, a row a second, at a steady speed, with bends as the function gives them.
template <class NorthOf>
TrajectoryFile eastward(double speed_m_per_s, int rows, NorthOf north_m) {
  TrajectoryFile file;
  file.name = "eastward";
  const nav::Geodetic start{30.0 * units::kDeg, 0.0, 100.0};
  for (int k = 0; k < rows; ++k) {
    const nav::Geodetic here = nav::displaced(start, {north_m(k), speed_m_per_s * k, 0.0});
    file.rows.push_back({time::Nanoseconds(1000000000LL * k), {here.latitude_rad, here.longitude_rad, 100.0}, {}, {}});
  }
  return file;
}

class RowMotionAt : public testing::TestWithParam<double> {};

TEST_P(RowMotionAt, PassesThroughEveryRow) {
  for (const auto table : {tables::vehicle, tables::aircraft}) {
    const TrajectoryFile file = rows::of_table(table(), GetParam(), 400.0);
    const auto truth = run(file, 200.0);
    const auto every = static_cast<std::size_t>(std::lround(200.0 / GetParam()));
    for (std::size_t k = 0; k < file.rows.size(); ++k) {
      const TruthState& at_row = truth[k * every];
      ASSERT_EQ(at_row.header.sim_time_ns, file.rows[k].time.count());
      ASSERT_LT(nav::ned_from(file.rows[k].position, geodetic_of(at_row)).norm(), kPlace_m) << k;
      // The angles of the row and back lose a few roundings.
      ASSERT_LT(nav::angle_between(nav::quaternion_from_rpy(*file.rows[k].rpy), at_row.q_nv), 4e-15) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, RowMotionAt, testing::Values(1.0, 10.0, 50.0),
                         [](const auto& rate) { return std::to_string(int(rate.param)) + "Hz"; });

TEST(RowMotion, TakesRowsAtIrregularTimes) {
  const TrajectoryFile regular = rows::of_table(tables::vehicle(), 200.0, 400.0);
  TrajectoryFile file = regular;
  file.rows.clear();
  // From 5 to 85 ms apart.
  for (std::size_t k = 0, step = 1; k < regular.rows.size(); k += 1 + (5 * ++step) % 17)
    file.rows.push_back(regular.rows[k]);
  const auto truth = run(file, 200.0);
  std::size_t row = 0;
  for (const TruthState& sample : truth) {
    if (sample.header.sim_time_ns != file.rows[row].time.count()) continue;
    ASSERT_LT(nav::ned_from(file.rows[row].position, geodetic_of(sample)).norm(), kPlace_m) << row;
    ++row;
  }
  EXPECT_EQ(row, file.rows.size());
  // A tenth of a second is short against the table's motions: between the rows the curve is close to them.
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_LT(nav::ned_from(regular.rows[i].position, geodetic_of(truth[i])).norm(), 2e-3) << i;
  }
}

TEST(RowMotion, SegmentIndexIsTheRowThatTheVehicleHasPassed) {
  const auto truth = run(rows::of_table(tables::vehicle(), 1.0, 10.0), 10.0);
  EXPECT_EQ(truth[0].segment_index, 0u);
  EXPECT_EQ(truth[9].segment_index, 0u);
  EXPECT_EQ(truth[10].segment_index, 1u);
  EXPECT_EQ(truth[15].segment_index, 1u);
}

TEST(RowMotion, WithoutAttitudesTheNosePointsAlongTheVelocity) {
  const TrajectoryFile file = rows::positions_of(rows::of_table(tables::aircraft(), 10.0, 400.0));
  const auto truth = run(file, 10.0);
  for (const TruthState& sample : truth) {
    if (std::hypot(sample.v_n.x(), sample.v_n.y()) < 0.3) continue;
    const Vector3 nose_n = nav::matrix_from_quaternion(sample.q_nv) * Vector3::UnitX();
    ASSERT_LT((nose_n - sample.v_n.normalized()).norm(), 1e-12) << sample.header.sim_time_ns;
  }
}

TEST(RowMotion, WithoutAttitudesATurnIsBankedUntilNothingPullsSideways) {
  // A circle of 2 deg/s at 60 m/s in the level: tan(bank) = v yaw'/g.
  TrajectoryFile file;
  file.name = "circle";
  const double rate = 2.0 * units::kDeg, radius_m = 60.0 / rate;
  const nav::Geodetic centre{-35.0 * units::kDeg, 149.0 * units::kDeg, 1000.0};
  for (int k = 0; k < 180; ++k) {
    nav::Geodetic here = nav::displaced(centre, {radius_m * std::sin(rate * k), -radius_m * std::cos(rate * k), 0.0});
    here.height_m = 1000.0;
    file.rows.push_back({time::Nanoseconds(1000000000LL * k), here, {}, {}});
  }
  const auto truth = run(file, 1.0);
  for (std::size_t i = 10; i + 10 < truth.size(); ++i) {
    // The Earth's curvature under a circle of 1.7 km and its Coriolis force pull by up to 9e-3 m/s^2.
    EXPECT_NEAR(nav::rpy_from_quaternion(truth[i].q_nv).roll_rad, std::atan(60.0 * rate / 9.80665), 2e-4) << i;
    EXPECT_NEAR(truth[i].f_v.y(), 0.0, 2e-2) << i;
  }
}

TEST(RowMotion, WithoutAttitudesTheBankStopsAtItsLimit) {
  TrajectoryFile file = eastward(20.0, 60, [](int k) { return 80.0 * std::sin(0.3 * k); });
  scenario::VehicleAttitude level;
  level.max_bank_deg = 0.0;
  SmoothModel model(motion_through(file, level), "row", nav::Gravity(), time::Rate(1.0), {2300, 0});
  for (int k = 0; k < 59; ++k) {
    EXPECT_NEAR(nav::rpy_from_quaternion(model.current().q_nv).roll_rad, 0.0, 1e-12);
    model.advance();
  }
}

TEST(RowMotion, WithoutAttitudesAStandingVehicleKeepsItsHeading) {
  // 20 s east at 10 m/s, then 20 s at rest.
  TrajectoryFile file = eastward(10.0, 41, [](int) { return 0.0; });
  for (std::size_t k = 21; k < 41; ++k) file.rows[k].position = file.rows[20].position;
  const auto truth = run(file, 1.0);
  for (std::size_t i = 25; i < truth.size(); ++i) {
    const nav::RollPitchYaw rpy = nav::rpy_from_quaternion(truth[i].q_nv);
    EXPECT_NEAR(rpy.yaw_rad, 90.0 * units::kDeg, 1e-4);
    EXPECT_NEAR(rpy.roll_rad, 0.0, 1e-15);
  }
  // And one that has yet to move has the heading it will have.
  for (std::size_t k = 0; k < 20; ++k) file.rows[k].position = file.rows[20].position;
  for (std::size_t k = 21; k < 41; ++k)
    file.rows[k].position = eastward(10.0, 41, [](int) { return 0.0; }).rows[k].position;
  EXPECT_NEAR(nav::rpy_from_quaternion(run(file, 1.0).front().q_nv).yaw_rad, 90.0 * units::kDeg, 1e-2);
}

TEST(RowMotion, EndsWithItsLastRow) {
  SmoothModel model = model_of(rows::of_table(tables::vehicle(), 1.0, 3.0), 1.0);
  for (int i = 0; i < 3; ++i) model.advance();
  EXPECT_THROW(model.advance(), std::domain_error);
}

TEST(RowMotion, RefusesOneRowAndPlacesOutsideTheDomain) {
  TrajectoryFile file = rows::of_table(tables::vehicle(), 1.0, 3.0);
  file.rows[2].position.height_m = 2e5;
  EXPECT_THROW(motion_through(file, {}), std::domain_error);
  file.rows.resize(1);
  EXPECT_THROW(motion_through(file, {}), std::invalid_argument);
}

}  // namespace row_motion_test
}  // namespace inslab::trajectory
