#include "inslab/models/trajectory/truth_model.hpp"

#include <gtest/gtest.h>

#include "inslab/data/json/config_error.hpp"
#include "inslab/models/trajectory/inverse_mechanization_model.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/models/trajectory/smooth_model.hpp"
#include "tests/unit/models/trajectory/file_rows.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

namespace inslab::trajectory {
namespace truth_model_test {

scenario::LoadedScenario loaded(const std::string& name) {
  return scenario::load(std::string(INSLAB_SOURCE_DIR) + "/tests/data/" + name);
}

TEST(TruthModel, IsTheMotionTablesForAMotionTable) {
  const auto model = make_truth_model(loaded("short.json"), {2300, 0});
  EXPECT_NE(dynamic_cast<const MotionTableModel*>(model.get()), nullptr);
}

TEST(TruthModel, NamesTheFileWhoseMotionCannotBegin) {
  scenario::LoadedScenario scenario = loaded("short.json");
  scenario.scenario.trajectory.initial.speed_m_per_s = 0.0;
  scenario.scenario.trajectory.segments = {tables::segment(10.0, {tables::ballistic()})};
  try {
    make_truth_model(scenario, {2300, 0});
    FAIL();
  } catch (const json::Error& error) {
    EXPECT_EQ(error.file(), scenario.file.string());
    EXPECT_EQ(error.path(), "trajectory");
    EXPECT_NE(std::string(error.what()).find("speed is 0"), std::string::npos) << error.what();
  }
}

TEST(TruthModel, FollowsTheRowsOfTheScenariosFile) {
  const scenario::LoadedScenario scenario = loaded("from_file.json");
  const auto model = make_truth_model(scenario, {2300, 0});
  TruthState truth = model->current();
  for (std::uint64_t k = 1; k < scenario.truth_samples; ++k) truth = model->advance();
  const TrajectoryRow& last = scenario.trajectory_file->rows.back();
  ASSERT_EQ(truth.header.sim_time_ns, last.time.count());
  // Velocity linear over the 0.1 s between rows, where the turn's jerk is below 6 m/s^3: h^2/12 of it, for 8 s.
  EXPECT_LT(nav::ned_from(last.position, state_of(truth).position).norm(), 6.0 * 0.01 / 12.0 * 8.0);
  EXPECT_LT(nav::angle_between(truth.q_nv, nav::quaternion_from_rpy(*last.rpy)), 1e-14);
}

TEST(TruthModel, TakesFeedbackAndRotationTermFromTheScenario) {
  scenario::LoadedScenario scenario = loaded("from_file.json");
  const auto dv_after_second = [&scenario] {
    const auto model = make_truth_model(scenario, {2300, 0});
    for (int k = 0; k < 399; ++k) model->advance();
    return model->advance().dv_v;
  };
  const Vector3 as_declared = dv_after_second();
  scenario.scenario.trajectory.file.full_rotation_term = true;
  EXPECT_NE(dv_after_second(), as_declared);
  scenario.scenario.trajectory.file.full_rotation_term = false;
  scenario.scenario.trajectory.file.position_feedback_per_s = 0.02;
  EXPECT_NE(dv_after_second(), as_declared);
}

TEST(TruthModel, PassesThroughTheRowsOfTheScenariosFileInSplineMode) {
  scenario::LoadedScenario scenario = loaded("from_file.json");
  scenario.scenario.trajectory.file.method = scenario::FileMethod::Spline;
  const auto model = make_truth_model(scenario, {2300, 0});
  ASSERT_NE(dynamic_cast<const SmoothModel*>(model.get()), nullptr);
  TruthState truth = model->current();
  for (std::uint64_t k = 1; k < scenario.truth_samples; ++k) truth = model->advance();
  const TrajectoryRow& last = scenario.trajectory_file->rows.back();
  EXPECT_LT(nav::ned_from(last.position, state_of(truth).position).norm(), 3e-9);
  EXPECT_LT(nav::angle_between(truth.q_nv, nav::quaternion_from_rpy(*last.rpy)), 1e-14);
}

TEST(TruthModel, StandsAtTheLastWaypointUntilTheEndOfTheRun) {
  scenario::LoadedScenario scenario = loaded("short.json");
  scenario.scenario.trajectory.source = scenario::TrajectorySource::Waypoints;
  scenario.scenario.trajectory.waypoints = {{30.0, 114.0, 20.0, 10.0, 0.0}, {30.0, 114.0001, 20.0, 0.0, 0.0}};
  scenario.truth_samples = 2001;
  const auto model = make_truth_model(scenario, {2300, 0});
  TruthState truth = model->current();
  for (std::uint64_t k = 1; k < scenario.truth_samples; ++k) truth = model->advance();
  EXPECT_EQ(truth.v_n, Vector3::Zero());
}

}  // namespace truth_model_test
}  // namespace inslab::trajectory
