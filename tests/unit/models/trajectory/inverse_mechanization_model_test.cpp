#include "inslab/models/trajectory/inverse_mechanization_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/unit/models/trajectory/file_rows.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace inverse_mechanization_model_test {

const time::Rate kRate(200.0);
const time::GpsTime kStart{2300, 604'799'000'000'000};

/// A minute from the busy part of a table.
TrajectoryFile driving(double rate_hz = 200.0) {
  scenario::Trajectory table = tables::vehicle();
  table.segments.erase(table.segments.begin());
  return rows_of(table, rate_hz, 60.0);
}

InverseMechanizationModel model_of(const TrajectoryFile& file, const InverseMechanizationModel::Options& options = {}) {
  return InverseMechanizationModel(std::make_shared<TrajectoryFile>(file), nav::Gravity(), options, kRate, kStart);
}

nav::Vector3 position_error_m(const TruthState& truth, const TrajectoryRow& row) {
  return nav::ned_from(row.position, state_of(truth).position);
}

TEST(InverseMechanizationModel, BeginsWithTheFirstRow) {
  const TrajectoryFile file = driving();
  const TruthState truth = model_of(file).current();
  EXPECT_LT(position_error_m(truth, file.rows[0]).norm(), 3e-9);
  EXPECT_EQ(truth.v_n, *file.rows[0].v_n);
  EXPECT_EQ(truth.header.sim_time_ns, 0);
  EXPECT_EQ(truth.interval_ns, 0);
  EXPECT_EQ(truth.dtheta_v, Vector3::Zero());
  EXPECT_EQ(truth.dv_v, Vector3::Zero());
}

TEST(InverseMechanizationModel, CountsSamplesOnTheGridAndCarriesTheWeek) {
  InverseMechanizationModel model = model_of(driving());
  for (int k = 0; k < 200; ++k) model.advance();
  const TruthState truth = model.advance();
  EXPECT_EQ(truth.header.sequence_number, 201U);
  EXPECT_EQ(truth.header.sim_time_ns, 1'005'000'000);
  EXPECT_EQ(truth.interval_ns, 5'000'000);
  EXPECT_EQ(truth.header.gps_week, 2301U);
  EXPECT_EQ(truth.header.gps_time_of_week_ns, 5'000'000);
}

TEST(InverseMechanizationModel, MeetsAttitudeAndVelocityOfEveryRowAndStaysAtItsPosition) {
  const TrajectoryFile file = driving();
  InverseMechanizationModel model = model_of(file);
  double position_m = 0.0, velocity_m_per_s = 0.0, attitude_rad = 0.0;
  for (std::size_t k = 1; k < file.rows.size(); ++k) {
    const TruthState truth = model.advance();
    position_m = std::max(position_m, position_error_m(truth, file.rows[k]).norm());
    velocity_m_per_s = std::max(velocity_m_per_s, (truth.v_n - *file.rows[k].v_n).norm());
    attitude_rad = std::max(attitude_rad, nav::angle_between(truth.q_nv, nav::quaternion_from_rpy(*file.rows[k].rpy)));
  }
  // The trapezoid of (2-47) errs by dt^2/12 of the acceleration's change, here at most 5 m/s^2.
  EXPECT_LT(position_m, 2.0 * 0.005 * 0.005 / 12.0 * 5.0);
  EXPECT_LT(velocity_m_per_s, 0.01 * position_m);
  EXPECT_LT(attitude_rad, 1e-15);
}

TEST(InverseMechanizationModel, IsFoundAgainByTheSameMechanizationToRounding) {
  for (const bool full_rotation_term : {false, true}) {
    InverseMechanizationModel::Options options;
    options.strapdown.full_rotation_term = full_rotation_term;
    InverseMechanizationModel model = model_of(driving(), options);
    nav::Strapdown strapdown(state_of(model.current()), nav::Gravity(), options.strapdown);
    TruthState truth;
    for (int k = 0; k < 12000; ++k) {
      truth = model.advance();
      strapdown.advance({truth.dtheta_v, truth.dv_v, kRate.period_s()});
    }
    // Two roundings of angles near 2 rad, as they are published.
    EXPECT_LT(nav::ned_from(state_of(truth).position, strapdown.position()).norm(), 6e-9);
    EXPECT_LT((strapdown.v_n() - truth.v_n).norm(), 1e-12);
    EXPECT_LT(nav::angle_between(strapdown.q_nb(), truth.q_nv), 1e-14);
  }
}

TEST(InverseMechanizationModel, PublishesTheRateAndSpecificForceOfTheMotion) {
  scenario::Trajectory table = tables::at_wuhan();
  table.initial.speed_m_per_s = 10.0;
  table.segments = {
      tables::segment(60.0, {tables::sinusoid(scenario::MotionType::SineRate, 10.0, 6.0, tables::Axis::Z)})};
  MotionTableModel motion(table, kRate, kStart);
  InverseMechanizationModel model = model_of(rows_of(table, 200.0, 60.0));
  for (int k = 0; k < 5000; ++k) {
    const TruthState expected = motion.advance(), found = model.advance();
    // dt^2/6 of the second derivative: 0.175 rad/s and 1.75 m/s^2 of period 6 s, and 2e-12 m/s of rounding in dv.
    const double swing = std::pow(2.0 * 3.14159265358979323846 / 6.0 * 0.005, 2.0) / 6.0;
    ASSERT_LT((found.omega_iv_v - expected.omega_iv_v).norm(), 0.175 * swing * 1.1);
    ASSERT_LT((found.f_v - expected.f_v).norm(), 1.75 * swing * 1.1 + 1e-6);
  }
}

TEST(InverseMechanizationModel, BoundsThePositionErrorOfAFileWhoseVelocityContradictsItsPositions) {
  const Vector3 contradiction_m_per_s(0.01, -0.02, 0.005);
  TrajectoryFile file = rows_of(tables::at_wuhan(), 10.0, 300.0);
  for (TrajectoryRow& row : file.rows) *row.v_n += contradiction_m_per_s;
  InverseMechanizationModel::Options options;
  options.position_feedback_per_s = 0.05;
  InverseMechanizationModel model = model_of(file, options);
  TruthState truth;
  for (int k = 0; k < 60000; ++k) truth = model.advance();
  // The error ends where the feedback cancels the contradiction; after 300 s e^-15 of that is missing.
  const Vector3 expected_m = contradiction_m_per_s / 0.05;
  EXPECT_LT((position_error_m(truth, file.rows.back()) - expected_m).norm(), 1e-4 * expected_m.norm());
}

TEST(InverseMechanizationModel, WithoutFeedbackTheContradictionAddsUp) {
  TrajectoryFile file = rows_of(tables::at_wuhan(), 10.0, 100.0);
  for (TrajectoryRow& row : file.rows) *row.v_n += Vector3(0.01, 0.0, 0.0);
  InverseMechanizationModel::Options options;
  options.position_feedback_per_s = 0.0;
  InverseMechanizationModel model = model_of(file, options);
  TruthState truth;
  for (int k = 0; k < 20000; ++k) truth = model.advance();
  EXPECT_NEAR(position_error_m(truth, file.rows.back()).x(), 1.0, 1e-4);
}

TEST(InverseMechanizationModel, TakesIrregularRowsThatDoNotLieOnTheGrid) {
  const TrajectoryFile dense = driving(1000.0);
  TrajectoryFile irregular = dense;
  irregular.rows.clear();
  // Every 1, 2, ... 99 ms.
  for (std::size_t i = 0, step = 1; i < dense.rows.size(); i += step, step = step % 99 + 1) {
    irregular.rows.push_back(dense.rows[i]);
  }
  InverseMechanizationModel model = model_of(irregular);
  double position_m = 0.0;
  while (time::Nanoseconds(model.current().header.sim_time_ns) < model.end()) {
    const TruthState truth = model.advance();
    position_m = std::max(position_m, position_error_m(truth, dense.rows[5 * truth.header.sequence_number]).norm());
  }
  // Velocity linear over 0.1 s under a jerk of at most 6 m/s^3 errs by h^2/12 of it on the mean, for some seconds.
  EXPECT_LT(position_m, 0.01);
  EXPECT_GE(time::to_seconds(model.end()), 59.8);
}

TEST(InverseMechanizationModel, EndsWithTheFile) {
  TrajectoryFile file = driving();
  file.rows.resize(11);
  InverseMechanizationModel model = model_of(file);
  EXPECT_EQ(model.end(), time::Nanoseconds(50'000'000));
  for (int k = 0; k < 10; ++k) model.advance();
  EXPECT_TRUE(model.current().omega_iv_v.allFinite());
  EXPECT_THROW(model.advance(), std::domain_error);
}

TEST(InverseMechanizationModel, RefusesToLeaveTheDomain) {
  TrajectoryFile file = rows_of(tables::at_wuhan(), 200.0, 1.0);
  for (TrajectoryRow& row : file.rows) {
    row.position.height_m = 99990.0 + 100.0 * time::to_seconds(row.time);
    row.v_n = Vector3(0.0, 0.0, -100.0);
  }
  InverseMechanizationModel model = model_of(file);
  EXPECT_THROW(for (int k = 0; k < 200; ++k) model.advance(), std::domain_error);
}

}  // namespace inverse_mechanization_model_test
}  // namespace inslab::trajectory
