#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "inslab/models/imu/imu_model.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

/// Every term at once, and the limits of the sensor, as the whole model puts them out.
namespace inslab::imu {
namespace model_terms_test {

constexpr std::int64_t kPeriodNs = 5000000;
constexpr double kPeriodS = 5e-3;
const nav::Gravity kGravity;

const std::vector<TruthState>& motion() {
  static const std::vector<TruthState> truth = [] {
    std::vector<TruthState> samples;
    for (std::int64_t k = 0; k < 201; ++k) samples.push_back(test::AnalyticMotion().truth(k, kPeriodNs, kGravity));
    return samples;
  }();
  return truth;
}

ImuModel::Setup setup() { return {42, 0, time::Rate(200.0), kGravity, {}, {}, {}}; }

template <class Errors>
void add_every_common_term(Errors& errors) {
  errors.bias_gm_correlation_time_s.setConstant(100.0);
  errors.scale_factor_ppm = {100.0, 200.0, -300.0};
  errors.scale_factor_turn_on_sigma_ppm.setConstant(200.0);
  errors.scale_factor_gm_sigma_ppm.setConstant(200.0);
  errors.scale_factor_gm_correlation_time_s.setConstant(50.0);
  errors.scale_factor_temperature_ppm_per_deg_c.setConstant(5.0);
  errors.scale_factor_asymmetry_ppm.setConstant(50.0);
  errors.nonlinearity_ppm_of_full_scale.setConstant(50.0);
  errors.cross_axis_arcsec << 10, 20, 30, 40, 50, 60;
  errors.bandwidth_hz = {30.0, 50.0, 0.0};
  errors.bandwidth_order = FilterOrder::Second;
}

/// Every term of the profile.
ImuErrorProfile every_term() {
  ImuErrorProfile profile;
  add_every_common_term(profile.gyro);
  add_every_common_term(profile.accel);
  profile.gyro.bias_constant_deg_per_h = {10.0, -20.0, 30.0};
  profile.gyro.bias_turn_on_sigma_deg_per_h.setConstant(5.0);
  profile.gyro.bias_gm_sigma_deg_per_h.setConstant(8.0);
  profile.gyro.bias_random_walk_deg_per_h_per_sqrt_h.setConstant(3.0);
  profile.gyro.bias_instability_deg_per_h.setConstant(2.0);
  profile.gyro.bias_temperature_deg_per_h_per_deg_c.setConstant(1.0);
  profile.gyro.arw_deg_per_sqrt_h.setConstant(0.26);
  profile.gyro.g_sensitivity_deg_per_h_per_g << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  profile.gyro.full_scale_deg_per_s.setConstant(25.0);
  profile.gyro.quantization_arcsec.setConstant(1.0);
  profile.accel.bias_constant_mgal = {100.0, 200.0, 300.0};
  profile.accel.bias_turn_on_sigma_mgal.setConstant(500.0);
  profile.accel.bias_gm_sigma_mgal.setConstant(129.0);
  profile.accel.bias_random_walk_mgal_per_sqrt_h.setConstant(10.0);
  profile.accel.bias_instability_mgal.setConstant(20.0);
  profile.accel.bias_temperature_mgal_per_deg_c.setConstant(10.0);
  profile.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.029);
  profile.accel.nonlinearity_ppm_per_g.setConstant(100.0);
  profile.accel.full_scale_g.setConstant(1.01);
  profile.accel.quantization_m_per_s.setConstant(1e-4);
  profile.temperature = {{0.0, 20.0}, {1.0, 50.0}};
  profile.latency_s = 0.003;
  profile.drop_probability = 0.05;
  profile.accel_delay_s = 0.0017;
  profile.accel_place_m << 0.02, 0.01, 0.0, -0.01, 0.03, 0.0, 0.0, 0.02, -0.02;
  profile.gyro_cross_axis_gm_sigma_arcsec.setConstant(10.0);
  profile.gyro_cross_axis_gm_correlation_time_s.setConstant(50.0);
  profile.accel_cross_axis_gm_sigma_arcsec.setConstant(10.0);
  profile.accel_cross_axis_gm_correlation_time_s.setConstant(50.0);
  profile.gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min.setConstant(1.0);
  profile.accel_bias_temperature_rate_mgal_per_deg_c_per_min.setConstant(10.0);
  profile.gyro_bias_hysteresis_deg_per_h.setConstant(3.0);
  profile.accel_bias_hysteresis_mgal.setConstant(30.0);
  profile.accel_rectification_mgal_per_g2.setConstant(20.0);
  profile.gyro_g2_sensitivity_deg_per_h_per_g2.setConstant(0.1);
  profile.gyro_anisoelasticity_deg_per_h_per_g2.setConstant(0.1);
  profile.gyro_anisoinertia_deg_per_h_per_deg2_per_s2.setConstant(0.01);
  return profile;
}

VibrationProfile shaking() {
  VibrationProfile profile;
  profile.linear.push_back({Vector3(1.0, 2.0, 3.0), 37.0, Vector3::Zero()});
  profile.angular.push_back({Vector3(0.5, 0.5, 0.5), 37.0, Vector3::Zero()});
  profile.linear_random = {{10.0, Vector3::Constant(0.01)}, {80.0, Vector3::Constant(0.01)}};
  profile.angular_random = {{10.0, Vector3::Constant(0.01)}, {80.0, Vector3::Constant(0.01)}};
  return profile;
}

ImuModel::Setup full_setup() {
  ImuModel::Setup s = setup();
  s.errors = every_term();
  s.vibration = shaking();
  s.installation.lever_arm_v_m = {0.8, -0.5, 1.5};
  s.installation.mounting_rpy_deg = {1.0, 2.0, 90.0};
  return s;
}

std::vector<ImuModel::Output> run(ImuModel model) {
  std::vector<ImuModel::Output> outputs;
  for (const TruthState& t : motion()) {
    if (auto output = model.measure(t)) outputs.push_back(*output);
  }
  return outputs;
}

ImuModel::Output first_with(const ImuModel::Setup& s, const FaultProfile& fault) {
  ImuModel model(s);
  model.measure(motion()[0]);
  model.measure(motion()[1]);
  model.apply(fault);
  return *model.measure(motion()[2]);
}

TEST(ImuModelTerms, TheBudgetOfEveryTermSumsToOutputMinusTruth) {
  // Nine terms of at most 0.1 (rad | m/s) are added up twice: 18 roundings of 1.4e-17.
  bool saturated = false, dropped = false;
  for (const auto& [sample, truth] : run(ImuModel(full_setup()))) {
    EXPECT_LT((truth.gyro_error.sum() - (sample.dtheta_b - truth.dtheta_b)).cwiseAbs().maxCoeff(), 2.6e-16);
    EXPECT_LT((truth.accel_error.sum() - (sample.dv_b - truth.dv_b)).cwiseAbs().maxCoeff(), 2.6e-16);
    EXPECT_NE(truth.accel_error.delay, Vector3::Zero());
    EXPECT_NE(truth.accel_error.size_effect, Vector3::Zero());
    EXPECT_NE(truth.gyro_error.g_sensitivity, Vector3::Zero());
    EXPECT_NE(truth.gyro_error.limits, Vector3::Zero());
    saturated = saturated || (sample.gyro_saturated && sample.accel_saturated);
    dropped = dropped || !sample.gyro_valid;
  }
  EXPECT_TRUE(saturated);
  EXPECT_TRUE(dropped);
}

TEST(ImuModelTerms, NoTermReachesTheTruth) {
  ImuModel::Setup perfect = full_setup();
  perfect.errors = {};
  perfect.vibration = {};
  const auto with = run(ImuModel(full_setup())), without = run(ImuModel(perfect));
  for (std::size_t k = 0; k < with.size(); ++k) {
    EXPECT_EQ(with[k].truth.dtheta_b, without[k].sample.dtheta_b);
    EXPECT_EQ(with[k].truth.dv_b, without[k].sample.dv_b);
    EXPECT_EQ(with[k].truth.q_nb.coeffs(), without[k].truth.q_nb.coeffs());
  }
}

TEST(ImuModelTerms, TheSameSetupGivesTheSameBits) {
  const auto a = run(ImuModel(full_setup())), b = run(ImuModel(full_setup()));
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].sample.dtheta_b, b[k].sample.dtheta_b);
    EXPECT_EQ(a[k].sample.dv_b, b[k].sample.dv_b);
  }
}

TEST(ImuModelTerms, TemperatureDrivesBiasAndScaleFactorAndIsReported) {
  ImuModel::Setup s = setup();
  s.errors.temperature = {{0.0, 20.0}, {1.0, 120.0}};
  s.errors.accel.bias_temperature_mgal_per_deg_c.setConstant(10.0);
  s.errors.accel.scale_factor_temperature_ppm_per_deg_c.setConstant(50.0);
  const ImuModel::Output output = run(ImuModel(s))[99];  // ends at 0.5 s: 50 deg C above
  EXPECT_DOUBLE_EQ(output.sample.temperature_deg_c, 70.0);
  EXPECT_NEAR(output.truth.accel_error.bias.x(), 500e-5 * kPeriodS, 1e-18);
  EXPECT_TRUE(output.truth.accel_error.scale.isApprox(2500e-6 * output.truth.dv_b, 1e-12));
}

TEST(ImuModelTerms, GSensitivityFollowsTheForceThatTheGyrosFeel) {
  ImuModel::Setup s = setup();
  s.errors.gyro.g_sensitivity_deg_per_h_per_g.setConstant(100.0);
  s.vibration = shaking();
  for (const auto& [sample, truth] : run(ImuModel(s))) {
    const double felt = (truth.dv_b + truth.accel_error.vibration).sum();
    const double expected = 100.0 * units::kDegPerH / units::kG * felt;
    EXPECT_NEAR(truth.gyro_error.g_sensitivity.y(), expected, 1e-18);  // increments of 5e-7
  }
}

TEST(ImuModelTerms, LatencySaysWhenTheSampleIsThere) {
  ImuModel::Setup s = setup();
  s.errors.latency_s = 0.003;
  const ImuModel::Output output = run(ImuModel(s))[0];
  EXPECT_EQ(output.sample.available_sim_time_ns, kPeriodNs + 3000000);
  EXPECT_EQ(output.sample.header.sim_time_ns, kPeriodNs);
}

TEST(ImuModelTerms, ADroppedSampleKeepsItsPlaceWithoutIncrementsAndIsNotValid) {
  ImuModel::Setup s = setup();
  s.errors.drop_probability = 0.5;
  int dropped = 0;
  std::uint64_t expected = 0;
  for (const auto& [sample, truth] : run(ImuModel(s))) {
    EXPECT_EQ(sample.header.sequence_number, expected++);
    EXPECT_EQ(sample.gyro_valid, sample.accel_valid);
    if (!sample.gyro_valid) {
      ++dropped;
      EXPECT_EQ(sample.dtheta_b, Vector3::Zero());
      EXPECT_EQ(truth.gyro_error.limits, -truth.dtheta_b);
    } else {
      EXPECT_EQ(sample.dv_b, truth.dv_b);
    }
  }
  EXPECT_GT(dropped, 60);  // of 200 at 1/2: six standard deviations of 7
  EXPECT_LT(dropped, 140);
}

TEST(ImuModelTerms, FaultsOfAxesTouchTheOutputAndAreBookedAsLimits) {
  FaultProfile fault;
  fault.gyro_axes = {AxisFault::SignFlip, AxisFault::None, AxisFault::Nan};
  fault.accel_axes = {AxisFault::None, AxisFault::Stuck, AxisFault::None};
  fault.request.journal_number = 4;
  const ImuModel::Output before = run(ImuModel(setup()))[0], out = first_with(setup(), fault);
  EXPECT_EQ(out.sample.dtheta_b.x(), -out.truth.dtheta_b.x());
  EXPECT_EQ(out.sample.dtheta_b.y(), out.truth.dtheta_b.y());
  EXPECT_TRUE(std::isnan(out.sample.dtheta_b.z()));
  EXPECT_EQ(out.sample.dv_b.y(), before.sample.dv_b.y());
  EXPECT_DOUBLE_EQ(out.truth.gyro_error.limits.x(), -2.0 * out.truth.dtheta_b.x());
  EXPECT_TRUE(std::isfinite(out.truth.dtheta_b.z()));
  EXPECT_EQ(out.sample.revisions.fault, 4U);
}

TEST(ImuModelTerms, ASilentTriadLeavesTheOtherAlone) {
  FaultProfile fault;
  fault.gyro_silent = true;
  const ImuModel::Output out = first_with(setup(), fault);
  EXPECT_FALSE(out.sample.gyro_valid);
  EXPECT_EQ(out.sample.dtheta_b, Vector3::Zero());
  EXPECT_TRUE(out.sample.accel_valid);
  EXPECT_EQ(out.sample.dv_b, out.truth.dv_b);
}

TEST(ImuModelTerms, ANoiseBurstIsBookedAsNoise) {
  FaultProfile fault;
  fault.accel_noise_burst_m_per_s_per_sqrt_h.setConstant(5.0);
  const ImuModel::Output out = first_with(setup(), fault);
  EXPECT_NE(out.truth.accel_error.noise, Vector3::Zero());
  EXPECT_EQ(out.truth.gyro_error.noise, Vector3::Zero());
}

VibrationProfile mount() {
  VibrationProfile profile;
  profile.domain = VibrationDomain::Motion;
  profile.linear.push_back({Vector3(1.0, 2.0, 3.0), 7.0, Vector3::Zero()});
  profile.angular.push_back({Vector3(5.0, 5.0, 5.0), 7.0, Vector3::Zero()});
  return profile;
}

TEST(ImuModelTerms, AMovingMountIsPartOfTheTruthAndNoError) {
  ImuModel::Setup moving = setup();
  moving.vibration = mount();
  const auto moved = run(ImuModel(moving)), still = run(ImuModel(setup()));
  for (std::size_t k = 0; k < moved.size(); ++k) {
    EXPECT_EQ(moved[k].sample.dtheta_b, moved[k].truth.dtheta_b);
    EXPECT_EQ(moved[k].sample.dv_b, moved[k].truth.dv_b);
    EXPECT_FALSE(moved[k].truth.discontinuity);
  }
  EXPECT_NE(moved[10].truth.height_m, still[10].truth.height_m);
  EXPECT_NE(moved[10].truth.q_nb.coeffs(), still[10].truth.q_nb.coeffs());
}

TEST(ImuModelTerms, AMountThatBeginsToMoveAtOnceIsADiscontinuityAndOneThatFadesIsNone) {
  for (const double fade_s : {0.0, 0.5}) {
    ImuModel model(setup());
    for (int k = 0; k < 10; ++k) model.measure(motion()[k]);
    VibrationProfile profile = mount();
    profile.request.fade_s = fade_s;
    model.apply(profile);
    EXPECT_EQ(model.measure(motion()[10])->truth.discontinuity, fade_s == 0.0);
    EXPECT_FALSE(model.measure(motion()[11])->truth.discontinuity);
  }
}

TEST(ImuModelTerms, ASlowerImuOnAMovingMountAddsTheIncrementsOfItsInterval) {
  ImuModel::Setup fast = full_setup(), slow = full_setup();
  fast.errors = slow.errors = {};
  fast.vibration = slow.vibration = mount();
  slow.imu_rate = time::Rate(50.0);
  const auto fast_outputs = run(ImuModel(fast)), slow_outputs = run(ImuModel(slow));
  for (std::size_t k = 0; k < slow_outputs.size(); ++k) {
    Vector3 dv = Vector3::Zero();
    for (std::size_t i = 0; i < 4; ++i) dv += fast_outputs[4 * k + i].sample.dv_b;
    EXPECT_LT((slow_outputs[k].sample.dv_b - dv).norm(), 1e-15);
    EXPECT_EQ(slow_outputs[k].truth.q_nb.coeffs(), fast_outputs[4 * k + 3].truth.q_nb.coeffs());
  }
}

TEST(ImuModelTerms, KeepCarriesFilterAndRemainderOnAndResetStartsThemAfresh) {
  ImuModel kept(full_setup()), swapped(full_setup()), reset(full_setup());
  ImuErrorProfile again = every_term(), afresh = every_term();
  afresh.request.continuity = Continuity::Reset;
  for (int k = 0; k < 60; ++k) {
    if (k == 50) {
      swapped.apply(again);
      reset.apply(afresh);
    }
    const auto a = kept.measure(motion()[k]), b = swapped.measure(motion()[k]), c = reset.measure(motion()[k]);
    if (k == 0) continue;
    EXPECT_EQ(a->sample.dtheta_b, b->sample.dtheta_b);
    if (k == 50) {
      EXPECT_NE(a->sample.dtheta_b, c->sample.dtheta_b);
    }
  }
}

}  // namespace model_terms_test
}  // namespace inslab::imu
