#include "inslab/models/trajectory/file_states.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/models/trajectory/file_rows.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace file_states_test {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::shared_ptr<TrajectoryFile> two_rows() {
  auto file = std::make_shared<TrajectoryFile>();
  file->name = "two.csv";
  file->rows.resize(2);
  file->rows[0].position = {0.5, 2.0, 100.0};
  file->rows[0].v_n = nav::Vector3(10.0, 0.0, 0.0);
  file->rows[0].rpy = {0.0, 0.0, 6.2};
  file->rows[1].time = time::Nanoseconds(100'000'000);
  file->rows[1].position = nav::displaced(file->rows[0].position, {1.05, 0.0, 0.2});
  file->rows[1].v_n = nav::Vector3(11.0, 0.0, 2.0);
  file->rows[1].rpy = {0.0, 0.0, 0.1};
  return file;
}

TEST(FileStates, AtARowIsTheRow) {
  const auto file = two_rows();
  FileStates states(file);
  for (const TrajectoryRow& row : file->rows) {
    const nav::NavState state = states.at(row.time);
    EXPECT_EQ(state.position.latitude_rad, row.position.latitude_rad);
    EXPECT_EQ(state.position.height_m, row.position.height_m);
    EXPECT_EQ(state.v_n, *row.v_n);
    EXPECT_EQ(nav::angle_between(state.q_nb, nav::quaternion_from_rpy(*row.rpy)), 0.0);
  }
}

TEST(FileStates, BetweenRowsVelocityIsLinearAndYawTakesTheShortWay) {
  FileStates states(two_rows());
  const nav::NavState state = states.at(time::Nanoseconds(50'000'000));
  EXPECT_NEAR((state.v_n - nav::Vector3(10.5, 0.0, 1.0)).norm(), 0.0, 1e-14);
  const double half_turn_rad = 0.5 * (0.1 - (6.2 - 2.0 * 3.14159265358979323846));
  EXPECT_NEAR(nav::rpy_from_quaternion(state.q_nb).yaw_rad, 0.1 - half_turn_rad, 1e-14);
}

TEST(FileStates, BetweenRowsPositionIsTheIntegralOfVelocityAndAShareOfWhatContradictsIt) {
  FileStates states(two_rows());
  const nav::NavState state = states.at(time::Nanoseconds(50'000'000));
  // North: 10 m/s for 0.05 s and 10 m/s^2; down: 20 m/s^2, and half of the 0.1 m that the rows go beyond.
  const nav::Vector3 way_m = nav::ned_from(two_rows()->rows[0].position, state.position);
  EXPECT_NEAR((way_m - nav::Vector3(0.5125, 0.0, 0.025 + 0.05)).norm(), 0.0, 2e-9);
}

TEST(FileStates, FollowsIrregularRows) {
  scenario::Trajectory weaving = tables::at_wuhan();
  weaving.initial.speed_m_per_s = 10.0;
  weaving.segments = {
      tables::segment(20.0, {tables::sinusoid(scenario::MotionType::SineRate, 10.0, 6.0, tables::Axis::Z)})};
  const TrajectoryFile dense = rows_of(weaving, 1000.0, 20.0);
  auto irregular = std::make_shared<TrajectoryFile>(dense);
  irregular->rows.clear();
  // Every 1, 2, ... 99 ms.
  for (std::size_t i = 0, step = 1; i < dense.rows.size(); i += step, step = step % 99 + 1) {
    irregular->rows.push_back(dense.rows[i]);
  }
  FileStates states(irregular);
  for (const TrajectoryRow& row : dense.rows) {
    if (row.time > states.end()) break;
    const nav::NavState state = states.at(row.time);
    // h^2/8 of the second derivative, at most v (omega^2 + omega') = 10 (0.175^2 + 0.175 * 2 pi/6) = 2.14 m/s^3.
    ASSERT_LT((state.v_n - *row.v_n).norm(), 2.14 * 0.099 * 0.099 / 8.0);
  }
}

TEST(FileStates, RefusesATimeBeyondTheRows) {
  FileStates states(two_rows());
  EXPECT_THAT([&] { states.at(time::Nanoseconds(100'000'001)); },
              ThrowsMessage<std::domain_error>(HasSubstr("two.csv has rows from 0.000000 s to 0.100000 s")));
}

TEST(FileStates, RefusesRowsWithoutAttitudeOrVelocity) {
  auto file = two_rows();
  file->rows[1].rpy.reset();
  EXPECT_THAT([&] { FileStates states(file); },
              ThrowsMessage<std::invalid_argument>("two.csv has rows without attitude"));
  file->rows[1].v_n.reset();
  EXPECT_THAT([&] { FileStates states(file); },
              ThrowsMessage<std::invalid_argument>("two.csv has rows without velocity"));
}

TEST(FileStates, RefusesASingleRow) {
  auto file = two_rows();
  file->rows.pop_back();
  EXPECT_THAT([&] { FileStates states(file); },
              ThrowsMessage<std::invalid_argument>("two.csv has fewer than two rows"));
}

}  // namespace file_states_test
}  // namespace inslab::trajectory
