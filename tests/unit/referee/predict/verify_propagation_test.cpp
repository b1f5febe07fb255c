#include <gtest/gtest.h>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/predict/error_growth.hpp"
#include "inslab/referee/verify/propagation.hpp"
#include "inslab/referee/verify/propagation_runs.hpp"
#include "inslab/scenario/load.hpp"
#include "tests/unit/referee/verify/rows_held.hpp"

/// `inslab verify propagation`, the drift with fewer seeds.
namespace inslab::predict {
namespace verify_propagation_test {

TEST(VerifyPropagation, FourSourcesFollowTheClosedFormAndTheLinearModel) {
  for (const verify::Table& table : verify::schuler_tables()) EXPECT_TRUE(verify::every_row_held(table));
}

TEST(VerifyPropagation, FreeHeightFollowsTheClosedForm) { EXPECT_TRUE(verify::every_row_held(verify::height_table())); }

TEST(VerifyPropagation, NavigationGradeDriftsAsPredicted) {
  EXPECT_TRUE(verify::every_row_held(verify::drift_table(24)));
}

TEST(ErrorGrowth, OfAConstantBiasIsTheLinearModel) {
  verify::RestingRun run;
  run.errors.accel.bias_constant_mgal.x() = 10.0;
  const verify::ErrorState linear = verify::propagate_linearly(run.start, nav::Vector3::Zero(), {1e-4, 0.0, 0.0},
                                                               run.vertical, run.duration_s, run.duration_s)
                                        .back();
  // Steps of a second, second order in each: (omega_s 1 s)^2 / 6 an hour, far below.
  EXPECT_NEAR(verify::predict_at_rest(run).position_n_m.x(), std::abs(linear[0]), 1e-5 * std::abs(linear[0]));
  EXPECT_EQ(verify::predict_at_rest(run).position_n_m.z(), 0.0);
}

TEST(ErrorGrowth, OfWhiteNoiseOfTheRateIsAWalkOfYaw) {
  verify::RestingRun run;
  run.duration_s = 100;
  run.errors.gyro.arw_deg_per_sqrt_h.z() = 0.6;
  // 0.6 deg/sqrt(h) is 0.01 deg/sqrt(s). In 100 s the Earth turns the walk by 0.4 deg out of the vertical: 3e-5 of it.
  EXPECT_NEAR(verify::predict_at_rest(run).attitude_n_rad.z(), 0.1 * units::kDeg, 1e-4 * 0.1 * units::kDeg);
}

TEST(ErrorGrowth, RefusesAStepOfNothing) {
  EXPECT_THROW(ErrorGrowth({}, {}, nav::Gravity(), Vertical::Held, 0.0), std::invalid_argument);
}

}  // namespace verify_propagation_test
}  // namespace inslab::predict
