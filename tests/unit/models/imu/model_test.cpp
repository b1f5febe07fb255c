#include <gtest/gtest.h>

#include <vector>

#include "inslab/models/imu/imu_model.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

namespace inslab::imu {
namespace model_test {

constexpr std::int64_t kPeriodNs = 5000000;
constexpr double kPeriodS = 5e-3;
const nav::Gravity kGravity;

std::vector<TruthState> drive(std::int64_t samples) {
  const test::AnalyticMotion motion;
  std::vector<TruthState> truth;
  for (std::int64_t k = 0; k < samples; ++k) truth.push_back(motion.truth(k, kPeriodNs, kGravity));
  return truth;
}

const std::vector<TruthState>& motion() {
  static const std::vector<TruthState> truth = drive(401);
  return truth;
}

ImuModel::Setup setup() { return {42, 0, time::Rate(200.0), kGravity, {}, {}, {}}; }

ImuErrorProfile every_error() {
  ImuErrorProfile profile;
  profile.gyro.bias_constant_deg_per_h = {10.0, -20.0, 30.0};
  profile.gyro.bias_turn_on_sigma_deg_per_h.setConstant(5.0);
  profile.gyro.bias_gm_sigma_deg_per_h.setConstant(8.0);
  profile.gyro.bias_gm_correlation_time_s.setConstant(100.0);
  profile.gyro.arw_deg_per_sqrt_h.setConstant(0.26);
  profile.gyro.scale_factor_ppm = {100.0, 200.0, -300.0};
  profile.gyro.cross_axis_arcsec << 10, 20, 30, 40, 50, 60;
  profile.accel.bias_constant_mgal = {100.0, 200.0, 300.0};
  profile.accel.bias_turn_on_sigma_mgal.setConstant(500.0);
  profile.accel.bias_gm_sigma_mgal.setConstant(129.0);
  profile.accel.bias_gm_correlation_time_s.setConstant(100.0);
  profile.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.029);
  profile.accel.scale_factor_ppm.setConstant(500.0);
  profile.accel.cross_axis_arcsec << -10, 20, -30, 40, -50, 60;
  return profile;
}

VibrationProfile shaking() {
  VibrationProfile profile;
  profile.linear.push_back({Vector3(1.0, 2.0, 3.0), 37.0, Vector3::Zero()});
  profile.angular.push_back({Vector3(0.5, 0.5, 0.5), 37.0, Vector3::Zero()});
  return profile;
}

ImuModel::Setup full_setup() {
  ImuModel::Setup s = setup();
  s.errors = every_error();
  s.vibration = shaking();
  s.installation.lever_arm_v_m = {0.8, -0.5, 1.5};
  s.installation.mounting_rpy_deg = {1.0, 2.0, 90.0};
  return s;
}

std::vector<ImuModel::Output> run(ImuModel model, const std::vector<TruthState>& truth = motion()) {
  std::vector<ImuModel::Output> outputs;
  for (const TruthState& t : truth) {
    if (auto output = model.measure(t)) outputs.push_back(*output);
  }
  return outputs;
}

TEST(ImuModel, APerfectImuAtTheReferencePointGivesTheTruthsIncrements) {
  const auto outputs = run(ImuModel(setup()));
  ASSERT_EQ(outputs.size(), motion().size() - 1);
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    const TruthState& truth = motion()[k + 1];
    EXPECT_EQ(outputs[k].sample.dtheta_b, truth.dtheta_v);
    EXPECT_EQ(outputs[k].sample.dv_b, truth.dv_v);
    EXPECT_EQ(outputs[k].truth.latitude_rad, truth.latitude_rad);
    EXPECT_EQ(outputs[k].truth.v_n, truth.v_n);
  }
}

TEST(ImuModel, SamplesAreNumberedFromZeroAndStampedAtTheEndOfTheirInterval) {
  std::vector<TruthState> truth = motion();
  truth[1].header.gps_week = 2300;
  truth[1].header.gps_time_of_week_ns = 345;
  truth[1].header.run_id.bytes[3] = 9;
  truth[1].header.publish_realtime_ns = 77;
  ImuModel model(setup());
  EXPECT_FALSE(model.measure(truth[0]).has_value());
  const auto first = model.measure(truth[1]);
  ASSERT_TRUE(first.has_value());
  for (const StreamHeader& header : {first->sample.header, first->truth.header}) {
    EXPECT_EQ(header.sequence_number, 0U);
    EXPECT_EQ(header.sim_time_ns, kPeriodNs);
    EXPECT_EQ(header.gps_week, 2300U);
    EXPECT_EQ(header.gps_time_of_week_ns, 345);
    EXPECT_EQ(header.run_id.bytes[3], 9);
    EXPECT_EQ(header.publish_realtime_ns, 0);
  }
  EXPECT_EQ(first->sample.interval_ns, kPeriodNs);
  EXPECT_EQ(first->sample.mean_f_b, first->sample.dv_b / kPeriodS);
  EXPECT_EQ(model.measure(truth[2])->sample.header.sequence_number, 1U);
}

TEST(ImuModel, TheBudgetSumsToOutputMinusTruth) {
  for (const auto& [sample, truth] : run(ImuModel(full_setup()))) {
    EXPECT_EQ(sample.dtheta_b, truth.dtheta_b + truth.gyro_error.sum());
    EXPECT_EQ(sample.dv_b, truth.dv_b + truth.accel_error.sum());
    EXPECT_NE(truth.gyro_error.vibration, Vector3::Zero());
    EXPECT_NE(truth.accel_error.noise, Vector3::Zero());
    EXPECT_EQ(truth.gyro_error.limits, Vector3::Zero());
  }
}

TEST(ImuModel, ErrorsDoNotReachTheTruth) {
  ImuModel::Setup perfect = full_setup();
  perfect.errors = {};
  perfect.vibration = {};
  const auto with = run(ImuModel(full_setup())), without = run(ImuModel(perfect));
  for (std::size_t k = 0; k < with.size(); ++k) {
    EXPECT_EQ(with[k].truth.dtheta_b, without[k].sample.dtheta_b);
    EXPECT_EQ(with[k].truth.dv_b, without[k].sample.dv_b);
  }
}

TEST(ImuModel, TheSameSetupGivesTheSameBitsAndAnotherSeedOrNumberDoesNot) {
  const auto a = run(ImuModel(full_setup())), b = run(ImuModel(full_setup()));
  ImuModel::Setup other_seed = full_setup(), other_number = full_setup();
  other_seed.seed = 43;
  other_number.sensor_number = 1;
  const auto c = run(ImuModel(other_seed)), d = run(ImuModel(other_number));
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].sample.dtheta_b, b[k].sample.dtheta_b);
    EXPECT_NE(a[k].sample.dtheta_b, c[k].sample.dtheta_b);
    EXPECT_NE(a[k].sample.dtheta_b, d[k].sample.dtheta_b);
  }
}

TEST(ImuModel, ACopyGoesOnAsTheOriginalDoes) {
  ImuModel original(full_setup());
  for (int k = 0; k < 100; ++k) original.measure(motion()[k]);
  ImuModel copy = original;
  for (int k = 100; k < 200; ++k) {
    EXPECT_EQ(original.measure(motion()[k])->sample.dv_b, copy.measure(motion()[k])->sample.dv_b);
  }
}

TEST(ImuModel, ASlowerImuAddsTheIncrementsOfItsInterval) {
  ImuModel::Setup slow = setup(), fast = setup();
  slow.imu_rate = time::Rate(50.0);
  slow.installation = fast.installation = full_setup().installation;
  slow.vibration = fast.vibration = shaking();
  const auto slow_outputs = run(ImuModel(slow)), fast_outputs = run(ImuModel(fast));
  ASSERT_EQ(slow_outputs.size(), 100U);
  for (std::size_t k = 0; k < slow_outputs.size(); ++k) {
    Vector3 dtheta = Vector3::Zero(), dv = Vector3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      dtheta += fast_outputs[4 * k + i].sample.dtheta_b;
      dv += fast_outputs[4 * k + i].sample.dv_b;
    }
    EXPECT_LT((slow_outputs[k].sample.dtheta_b - dtheta).norm(), 1e-15);  // rounding of 0.01 rad
    // The vibration's phase, up to 37 turns, is rounded at 4e-15 turns: 2.6e-14 rad of 3.7 m/s^2 over 20 ms.
    EXPECT_LT((slow_outputs[k].sample.dv_b - dv).norm(), 2e-15);
    EXPECT_EQ(slow_outputs[k].sample.header.sequence_number, k);
    EXPECT_EQ(slow_outputs[k].sample.interval_ns, 4 * kPeriodNs);
  }
}

TEST(ImuModel, ASwapTakesEffectFromTheNextIntervalOfTheImuAndMarksIt) {
  ImuModel::Setup slow = setup();
  slow.imu_rate = time::Rate(100.0);
  ImuModel model(slow);
  ImuErrorProfile profile;
  profile.gyro.bias_constant_deg_per_h.x() = 3600.0;
  profile.request.journal_number = 7;
  for (int k = 0; k <= 3; ++k) model.measure(motion()[k]);
  model.apply(profile);  // in the middle of the interval (10 ms, 20 ms]
  const auto second = model.measure(motion()[4]);
  EXPECT_EQ(second->truth.gyro_error.bias, Vector3::Zero());
  EXPECT_EQ(second->sample.revisions.imu_error, 0U);
  model.measure(motion()[5]);
  const auto third = model.measure(motion()[6]);
  EXPECT_DOUBLE_EQ(third->truth.gyro_error.bias.x(), 3.14159265358979323846 / 180.0 * 0.01);
  EXPECT_EQ(third->sample.revisions.imu_error, 7U);
  EXPECT_EQ(third->truth.revisions.imu_error, 7U);
}

TEST(ImuModel, ASwapOfTheNoiseKeepsItsDraws) {
  ImuModel kept(full_setup()), swapped(full_setup());
  ImuErrorProfile louder = every_error();
  louder.gyro.arw_deg_per_sqrt_h *= 2.0;
  for (int k = 0; k < 50; ++k) {
    if (k == 20) swapped.apply(louder);
    const auto a = kept.measure(motion()[k]), b = swapped.measure(motion()[k]);
    if (k >= 20) {
      EXPECT_TRUE(b->truth.gyro_error.noise.isApprox(2.0 * a->truth.gyro_error.noise, 1e-15));
      EXPECT_EQ(b->truth.accel_error.noise, a->truth.accel_error.noise);
      EXPECT_EQ(b->truth.gyro_error.bias, a->truth.gyro_error.bias);
    }
  }
}

TEST(ImuModel, AnInstallationSwapRelocatesTheImuWithoutAnImpulse) {
  // From the swap on the output is that of an IMU that always sat at the new place.
  ImuModel::Setup there = setup();
  there.installation = full_setup().installation;
  ImuModel swapped(setup()), always_there(there);
  InstallationProfile move = there.installation;
  move.request.journal_number = 3;
  for (int k = 0; k < 200; ++k) {
    if (k == 100) swapped.apply(move);
    const auto a = swapped.measure(motion()[k]), b = always_there.measure(motion()[k]);
    if (k == 0) continue;
    EXPECT_EQ(a->truth.discontinuity, k == 100);
    EXPECT_EQ(a->sample.revisions.installation, k < 100 ? 0U : 3U);
    if (k < 100) continue;
    EXPECT_EQ(a->sample.dtheta_b, b->sample.dtheta_b);
    EXPECT_EQ(a->sample.dv_b, b->sample.dv_b);
    EXPECT_EQ(a->truth.height_m, b->truth.height_m);
  }
}

TEST(ImuModel, ASwapToTheSameInstallationIsNoDiscontinuity) {
  ImuModel model(full_setup());
  model.measure(motion()[0]);
  model.apply(full_setup().installation);
  EXPECT_FALSE(model.measure(motion()[1])->truth.discontinuity);
}

TEST(ImuModel, AVibrationSwapFades) {
  ImuModel::Setup still = setup();
  ImuModel model(still);
  VibrationProfile profile = shaking();
  profile.request.fade_s = 1.0;
  profile.request.journal_number = 2;
  model.measure(motion()[0]);
  model.apply(profile);
  Vibration full(shaking(), {kPeriodS, 42, "imu0"});
  for (std::int64_t k = 1; k <= 400; ++k) {
    const auto output = model.measure(motion()[k]);
    const Increments at_full = full.increments((k - 1) * kPeriodNs, k * kPeriodNs);
    EXPECT_EQ(output->sample.revisions.vibration, 2U);
    // Weight (pi tau)^2/4 at most in the first interval, tau = 5 ms / 1 s: 6.2e-5 of the largest increment 3 * 5 ms.
    if (k == 1) {
      EXPECT_LT(output->truth.accel_error.vibration.norm(), 6.2e-5 * 5e-3 * Vector3(1, 2, 3).norm());
    }
    if (k > 200) {
      EXPECT_EQ(output->truth.accel_error.vibration, at_full.dv);
    }
  }
}

TEST(ImuModel, AFaultAddsItsJumpAndLeavesAgain) {
  ImuModel model(setup());
  FaultProfile fault;
  fault.accel_bias_jump_mgal = {0.0, 0.0, 1e5};
  fault.request.journal_number = 1;
  FaultProfile over;
  over.request.journal_number = 2;
  model.measure(motion()[0]);
  model.apply(fault);
  const auto during = model.measure(motion()[1]);
  EXPECT_DOUBLE_EQ(during->truth.accel_error.bias.z(), 1.0 * kPeriodS);
  EXPECT_EQ(during->sample.revisions.fault, 1U);
  model.apply(over);
  const auto after = model.measure(motion()[2]);
  EXPECT_EQ(after->truth.accel_error.bias, Vector3::Zero());
  EXPECT_EQ(after->sample.revisions.fault, 2U);
}

TEST(ImuModel, ARefusedProfileChangesNothing) {
  ImuModel model(full_setup()), untouched(full_setup());
  ImuErrorProfile wrong;
  wrong.gyro.bias_gm_sigma_deg_per_h.setConstant(1.0);  // without a correlation time
  EXPECT_THROW(model.apply(wrong), std::invalid_argument);
  InstallationProfile for_an_antenna;
  for_an_antenna.target.kind = SensorKind::Gnss;
  EXPECT_THROW(model.apply(for_an_antenna), std::invalid_argument);
  for (int k = 0; k < 3; ++k) {
    const auto a = model.measure(motion()[k]), b = untouched.measure(motion()[k]);
    if (k > 0) {
      EXPECT_EQ(a->sample.dv_b, b->sample.dv_b);
    }
  }
}

TEST(ImuModel, TruthThatDoesNotContinueIsRefusedAndNothingIsLost) {
  ImuModel model(full_setup()), untouched(full_setup());
  for (int k = 0; k < 3; ++k) {
    model.measure(motion()[k]);
    untouched.measure(motion()[k]);
  }
  EXPECT_THROW(model.measure(motion()[4]), std::invalid_argument);
  EXPECT_THROW(model.measure(motion()[2]), std::invalid_argument);
  EXPECT_EQ(model.measure(motion()[3])->sample.dv_b, untouched.measure(motion()[3])->sample.dv_b);
}

TEST(ImuModel, AnImuThatStartsLateWaitsForItsGrid) {
  ImuModel::Setup slow = setup();
  slow.imu_rate = time::Rate(50.0);
  ImuModel model(slow);
  for (int k = 2; k < 8; ++k) EXPECT_FALSE(model.measure(motion()[k]).has_value()) << k;
  const auto first = model.measure(motion()[8]);
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->sample.header.sequence_number, 1U);  // the interval (20 ms, 40 ms]
}

TEST(ImuModel, RefusesTruthThatLeavesOutAnInstantOfTheImu) {
  ImuModel::Setup faster = setup();
  faster.imu_rate = time::Rate(300.0);
  ImuModel model(faster);
  EXPECT_FALSE(model.measure(motion()[0]).has_value());
  EXPECT_THROW(model.measure(motion()[1]), std::invalid_argument);  // 5 ms: beyond the instant at 3.333333 ms
}

}  // namespace model_test
}  // namespace inslab::imu
