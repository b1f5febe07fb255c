#include "inslab/referee/predict/expected_errors.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/navigation/matching_parameters.hpp"
#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/models/trajectory/motion_table_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/error_model.hpp"
#include "inslab/nav/strapdown.hpp"
#include "inslab/referee/predict/response.hpp"
#include "tests/unit/models/trajectory/tables.hpp"

/// The expected errors against runs of the IMU model and the mechanization, and against the reference filter.
namespace inslab::predict {
namespace expected_errors_test {

using ErrorState = Eigen::Matrix<double, 9, 1>;

constexpr double kRateHz = 50.0;
constexpr int kSeconds = 60;
constexpr std::size_t kLastFix = 40 * static_cast<std::size_t>(kRateHz);

/// A car's minute with a hill: every axis turns and accelerates.
const std::vector<TruthState>& motion() {
  static const std::vector<TruthState> samples = [] {
    using namespace trajectory::tables;
    scenario::Trajectory table = at_wuhan();
    table.segments = {segment(5.0),
                      segment(10.0, {target_speed(15.0)}),
                      segment(10.0, {turn(100.0)}),
                      segment(10.0, {turn(12.0, Axis::Y), turn(15.0, Axis::X)}),
                      segment(10.0, {turn(-12.0, Axis::Y), turn(-70.0)}),
                      segment(15.0, {target_speed(5.0), turn(60.0)})};
    trajectory::MotionTableModel truth(table, time::Rate(kRateHz), {2300, 0});
    std::vector<TruthState> list{truth.current()};
    for (int k = 0; k < kSeconds * static_cast<int>(kRateHz); ++k) list.push_back(truth.advance());
    return list;
  }();
  return samples;
}

imu::ImuModel imu_of(const ImuErrorProfile& errors, std::uint64_t seed) {
  const time::Rate rate(kRateHz);
  return imu::ImuModel({seed, 0, rate, nav::Gravity(), errors, VibrationProfile{}, InstallationProfile{}});
}

/// A swap of the IMU's errors at this time; the profile says how.
using Swap = std::optional<ImuErrorProfile>;

nav::NavState end_of_run(const ImuErrorProfile& errors, std::uint64_t seed, const Swap& swap) {
  imu::ImuModel imu = imu_of(errors, seed);
  imu.measure(motion().front());
  nav::Strapdown strapdown(nav_state(motion().front()), nav::Gravity(), {});
  for (std::size_t k = 1; k < motion().size(); ++k) {
    if (swap && motion()[k - 1].header.sim_time_ns == swap->request.apply_at_ns) imu.apply(*swap);
    const ImuSample sample = imu.measure(motion()[k])->sample;
    strapdown.advance({sample.dtheta_b, sample.dv_b, 1.0 / kRateHz});
  }
  return strapdown.state();
}

/// delta r, delta v, phi at the end: against the same mechanization of a perfect IMU, whose own error goes out.
ErrorState error_of_run(const ImuErrorProfile& errors, std::uint64_t seed, const Swap& swap = {}) {
  static const nav::NavState perfect = end_of_run({}, 1, {});
  const nav::NavState found = end_of_run(errors, seed, swap);
  ErrorState x;
  x << nav::ned_from(perfect.position, found.position), found.v_n - perfect.v_n,
      nav::rotation_vector_from_quaternion(perfect.q_nb * found.q_nb.conjugate());
  return x;
}

ErrorState expected(const ImuErrorProfile& errors, const Swap& swap = {}, double step_s = 1.0 / kRateHz) {
  std::vector<catalog::AnyProfile> profiles{errors};
  if (swap) profiles.emplace_back(*swap);
  ExpectedErrors::Setup setup;
  setup.step_s = step_s;
  ExpectedErrors expectation(setup, profiles);
  imu::ImuModel imu = imu_of({}, 1);
  imu.measure(motion().front());
  for (std::size_t k = 1; k < motion().size(); ++k) expectation.add(imu.measure(motion()[k])->truth);
  const PredictedError& end = expectation.curve().back();
  ErrorState sigma;
  sigma << end.position_n_m, end.velocity_n_m_per_s, end.attitude_n_rad;
  return sigma;
}

/// One fixed term alone.
struct FixedTerm {
  const char* name;
  void (*set)(ImuErrorProfile&);
};

class ExpectedErrorsOfOneTerm : public testing::TestWithParam<FixedTerm> {};

TEST_P(ExpectedErrorsOfOneTerm, AreTheErrorThatItMakes) {
  ImuErrorProfile errors;
  GetParam().set(errors);
  const ErrorState found = error_of_run(errors, 1), sigma = expected(errors);
  // The model is linear: half of the largest angle, 0.4 deg, is 0.35 % of its effect. By group: a small component is a
  // difference of large ones.
  for (const int group : {0, 3, 6}) {
    const double size = sigma.segment<3>(group).norm();
    ASSERT_GT(size, 0.0);
    EXPECT_LT((found.segment<3>(group).cwiseAbs() - sigma.segment<3>(group)).norm(), 0.0035 * size)
        << found.segment<3>(group).transpose() << " expected " << sigma.segment<3>(group).transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Profile, ExpectedErrorsOfOneTerm,
    testing::Values(
        FixedTerm{"GyroBias", [](ImuErrorProfile& p) { p.gyro.bias_constant_deg_per_h.y() = 10.0; }},
        FixedTerm{"AccelBias", [](ImuErrorProfile& p) { p.accel.bias_constant_mgal.x() = 100.0; }},
        FixedTerm{"GyroScale", [](ImuErrorProfile& p) { p.gyro.scale_factor_ppm.z() = 200.0; }},
        FixedTerm{"AccelCross", [](ImuErrorProfile& p) { p.accel.cross_axis_arcsec[4] = 60.0; }},
        FixedTerm{"GyroCross", [](ImuErrorProfile& p) { p.gyro.cross_axis_arcsec[5] = 60.0; }},
        FixedTerm{"GSensitivity", [](ImuErrorProfile& p) { p.gyro.g_sensitivity_deg_per_h_per_g[2] = 5.0; }},
        FixedTerm{"GSquare", [](ImuErrorProfile& p) { p.gyro_g2_sensitivity_deg_per_h_per_g2[2] = 5.0; }},
        FixedTerm{"GProduct", [](ImuErrorProfile& p) { p.gyro_anisoelasticity_deg_per_h_per_g2[3] = 50.0; }},
        FixedTerm{"RateProduct", [](ImuErrorProfile& p) { p.gyro_anisoinertia_deg_per_h_per_deg2_per_s2[1] = 1.0; }},
        FixedTerm{"AccelTemperatureRate",
                  [](ImuErrorProfile& p) {
                    p.accel_bias_temperature_rate_mgal_per_deg_c_per_min.x() = 20.0;
                    p.temperature = {{5.0, 20.0}, {30.0, 25.0}, {45.0, 23.0}};
                  }},
        FixedTerm{"GyroTemperature",
                  [](ImuErrorProfile& p) {
                    p.gyro.bias_temperature_deg_per_h_per_deg_c.x() = 1.0;
                    p.temperature = {{0.0, 20.0}, {30.0, 50.0}, {60.0, 40.0}};
                  }},
        FixedTerm{"AccelScaleTemperature",
                  [](ImuErrorProfile& p) {
                    p.accel.scale_factor_temperature_ppm_per_deg_c.z() = 5.0;
                    p.temperature = {{10.0, 10.0}, {60.0, 50.0}};
                  }},
        FixedTerm{"GyroAsymmetry", [](ImuErrorProfile& p) { p.gyro.scale_factor_asymmetry_ppm.z() = 300.0; }},
        FixedTerm{"AccelCube",
                  [](ImuErrorProfile& p) {
                    p.accel.nonlinearity_ppm_of_full_scale.z() = 2000.0;
                    p.accel.full_scale_g.setConstant(5.0);
                  }},
        FixedTerm{"AccelSquare", [](ImuErrorProfile& p) { p.accel.nonlinearity_ppm_per_g.y() = 3000.0; }}),
    [](const auto& term) { return term.param.name; });

// With the sign, and the axis in b: the same bound.
TEST(Responses, AreTheSignedErrorsThatASensorsBiasMakes) {
  ImuErrorProfile errors;
  errors.gyro.bias_constant_deg_per_h.y() = 10.0;
  errors.accel.bias_constant_mgal.x() = -100.0;
  Responses responses({error_source("gyro_bias_y=10deg/h"), error_source("accel_bias_x=-100mGal")}, nav::Gravity(),
                      Vertical::Free);
  LinearMotion linear(nav::Gravity(), Vertical::Free, 1.0 / kRateHz);
  imu::ImuModel imu = imu_of({}, 1);
  imu.measure(motion().front());
  for (std::size_t k = 1; k < motion().size(); ++k) {
    if (const auto step = linear.advance(imu.measure(motion()[k])->truth)) responses.add(*step);
  }
  const ErrorState found = error_of_run(errors, 1);
  const ErrorState response = responses.list()[0].errors.back() + responses.list()[1].errors.back();
  for (const int group : {0, 3, 6}) {
    EXPECT_LT((found - response).segment<3>(group).norm(), 0.0035 * response.segment<3>(group).norm())
        << found.segment<3>(group).transpose() << " expected " << response.segment<3>(group).transpose();
  }
}

TEST(ExpectedErrors, HardlyDependOnTheirStep) {
  ImuErrorProfile errors;
  errors.gyro.scale_factor_asymmetry_ppm.setConstant(300.0);
  errors.gyro.bias_instability_deg_per_h.setConstant(5.0);
  errors.accel.bias_turn_on_sigma_mgal.setConstant(50.0);
  const ErrorState fine = expected(errors), coarse = expected(errors, {}, 0.2);
  // A turn of 16 deg/s goes on by 3 deg in a step: 0.2 s off in a manoeuvre of 10 s is 2 % of its effect.
  EXPECT_LT((coarse - fine).cwiseQuotient(fine).cwiseAbs().maxCoeff(), 0.02);
}

TEST(ExpectedErrors, AfterASwapAreThoseOfTheNewTerms) {
  ImuErrorProfile before, after;
  after.accel.bias_constant_mgal.x() = 100.0;
  const double all_along_m = expected(after).head<3>().norm();
  after.request.apply_at_ns = 30'000'000'000;
  const ErrorState found = error_of_run(before, 1, after), sigma = expected(before, after);
  EXPECT_LT((found.cwiseAbs() - sigma).head<3>().norm(), 0.01 * sigma.head<3>().norm());
  EXPECT_LT(sigma.head<3>().norm(), 0.5 * all_along_m);
}

/// Mean squares over the runs of `runs` seeds in units of the expected variance: chi-square of as many degrees of
/// freedom over their number, whose standard deviation is sqrt(2 / runs).
void expect_spread(const ImuErrorProfile& errors, int runs, const Swap& swap = {}) {
  const ErrorState variance = expected(errors, swap).cwiseAbs2();
  ErrorState squares = ErrorState::Zero();
  for (int seed = 1; seed <= runs; ++seed) {
    squares += error_of_run(errors, static_cast<std::uint64_t>(seed), swap).cwiseAbs2() / runs;
  }
  const double margin = 4.0 * std::sqrt(2.0 / runs);
  for (int i = 0; i < 9; ++i) {
    ASSERT_GT(variance[i], 0.0);
    EXPECT_NEAR(squares[i] / variance[i], 1.0, margin) << "component " << i;
  }
}

TEST(ExpectedErrors, OfFlickerAreTheSpreadOfRuns) {
  ImuErrorProfile errors;
  errors.gyro.bias_instability_deg_per_h.setConstant(5.0);
  errors.accel.bias_instability_mgal.setConstant(50.0);
  expect_spread(errors, 150);
}

TEST(ExpectedErrors, OfDriftingCrossAxisAnglesAreTheSpreadOfRuns) {
  ImuErrorProfile errors;
  errors.gyro_cross_axis_gm_sigma_arcsec.setConstant(60.0);
  errors.gyro_cross_axis_gm_correlation_time_s.setConstant(15.0);
  errors.accel_cross_axis_gm_sigma_arcsec.setConstant(60.0);
  errors.accel_cross_axis_gm_correlation_time_s.setConstant(40.0);
  expect_spread(errors, 150);
}

TEST(ExpectedErrors, OfEveryRandomTermAreTheSpreadOfRuns) {
  ImuErrorProfile errors;
  errors.gyro.bias_turn_on_sigma_deg_per_h.setConstant(2.0);
  errors.gyro.bias_gm_sigma_deg_per_h.setConstant(5.0);
  errors.gyro.bias_gm_correlation_time_s.setConstant(20.0);
  errors.gyro.bias_random_walk_deg_per_h_per_sqrt_h.setConstant(20.0);
  errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  errors.gyro.scale_factor_turn_on_sigma_ppm.setConstant(200.0);
  errors.accel.bias_gm_sigma_mgal.setConstant(60.0);
  errors.accel.bias_gm_correlation_time_s.setConstant(5.0);
  errors.accel.bias_random_walk_mgal_per_sqrt_h.setConstant(200.0);
  errors.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.05);
  errors.accel.scale_factor_gm_sigma_ppm.setConstant(100.0);
  errors.accel.scale_factor_gm_correlation_time_s.setConstant(30.0);
  expect_spread(errors, 150);
}

TEST(ExpectedErrors, OverARedrawAreTheSpreadOfRuns) {
  ImuErrorProfile errors;
  errors.gyro.bias_turn_on_sigma_deg_per_h.setConstant(10.0);
  errors.accel.bias_gm_sigma_mgal.setConstant(60.0);
  errors.accel.bias_gm_correlation_time_s.setConstant(600.0);
  ImuErrorProfile other = errors;
  other.accel.bias_gm_sigma_mgal.setConstant(120.0);
  other.request.apply_at_ns = 30'000'000'000;
  other.request.continuity = Continuity::Redraw;
  expect_spread(errors, 100, other);
}

/// The filter that is told the same says the same of itself, with fixes and 20 s after the last.
TEST(ExpectedErrors, WithFixesAreTheSigmasOfAFilterThatMatches) {
  ImuErrorProfile errors;
  errors.gyro.bias_gm_sigma_deg_per_h.setConstant(5.0);
  errors.gyro.bias_gm_correlation_time_s.setConstant(300.0);
  errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  errors.accel.bias_gm_sigma_mgal.setConstant(60.0);
  errors.accel.bias_gm_correlation_time_s.setConstant(300.0);
  errors.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.05);
  GnssErrorProfile rtk;
  rtk.fix_type = FixType::Fixed;
  rtk.position_sigma_ned_m = Vector3(0.02, 0.02, 0.04);
  rtk.velocity_sigma_ned_m_per_s = Vector3(0.03, 0.03, 0.05);
  InstallationProfile roof;
  roof.target = {SensorKind::Gnss, 0};
  roof.lever_arm_v_m = Vector3(1.0, 0.4, -1.2);

  navigation::NavigationParameters parameters = navigation::matching_parameters(errors, {}, roof);
  parameters.initial.attitude_sigma_ned_deg = Vector3(0.2, 0.2, 1.0);
  parameters.zero_velocity.use = false;
  parameters.covariance_interval_s = 0.0;
  navigation::NavigationFilter filter(parameters, nav::Gravity());
  filter.start(nav_state(motion().front()), 0);
  ExpectedErrors::Setup setup;
  setup.gnss_number = 0;
  setup.start.position_n_m = parameters.initial.position_sigma_ned_m;
  setup.start.velocity_n_m_per_s = parameters.initial.velocity_sigma_ned_m_per_s;
  setup.start.attitude_n_rad = parameters.initial.attitude_sigma_ned_deg * units::kDeg;
  setup.step_s = 0.02;
  ExpectedErrors expectation(setup, {errors, rtk, roof});

  imu::ImuModel imu = imu_of({}, 1);
  imu.measure(motion().front());
  for (std::size_t k = 1; k < motion().size(); ++k) {
    const auto output = imu.measure(motion()[k]);
    const auto solution = filter.add(output->sample);
    expectation.add(output->truth);
    const bool is_epoch = k % 10 == 0, is_outage = k > kLastFix;
    if (k == kLastFix || k + 1 == motion().size()) {
      const PredictedError& now = expectation.curve().back();
      // Scale factors of 0 aside the models differ in what is of second order in a step of 0.02 s.
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(now.position_n_m[axis], solution->position_sigma_ned_m[axis], 0.01 * now.position_n_m[axis]);
        EXPECT_NEAR(now.velocity_n_m_per_s[axis], solution->velocity_sigma_ned_m_per_s[axis],
                    0.01 * now.velocity_n_m_per_s[axis]);
        EXPECT_NEAR(now.attitude_n_rad[axis], solution->attitude_sigma_rad[axis], 0.01 * now.attitude_n_rad[axis]);
      }
    }
    if (!is_epoch || is_outage) continue;
    GnssFix fix;
    fix.header = output->truth.header;
    fix.fix_type = FixType::Fixed;
    const nav::Matrix3 C_nb = nav::matrix_from_quaternion(motion()[k].q_nv);
    const nav::Geodetic antenna = nav::displaced(nav_state(motion()[k]).position, C_nb * roof.lever_arm_v_m);
    fix.latitude_rad = antenna.latitude_rad;
    fix.longitude_rad = antenna.longitude_rad;
    fix.height_m = antenna.height_m;
    fix.v_n = motion()[k].v_n + C_nb * motion()[k].omega_iv_v.cross(roof.lever_arm_v_m);
    fix.position_sigma_ned_m = rtk.position_sigma_ned_m;
    fix.velocity_sigma_ned_m_per_s = rtk.velocity_sigma_ned_m_per_s;
    filter.add(fix);
    expectation.add(fix);
  }
}

TEST(ExpectedErrors, OfAReceiverThatDriftsStayItsDrift) {
  GnssErrorProfile slow;
  slow.position_sigma_ned_m.setConstant(0.1);
  slow.position_gm_sigma_ned_m.setConstant(2.0);
  slow.position_gm_correlation_time_s.setConstant(900.0);
  ExpectedErrors::Setup setup;
  setup.gnss_number = 0;
  setup.start.position_n_m.setConstant(100.0);
  ExpectedErrors expectation(setup, {ImuErrorProfile{}, slow});
  GnssFix fix;
  fix.fix_type = FixType::Single;
  imu::ImuModel imu = imu_of({}, 1);
  imu.measure(motion().front());
  for (std::size_t k = 1; k <= 500; ++k) {
    expectation.add(imu.measure(motion()[k])->truth);
    if (k % 10 == 0) expectation.add(fix);
  }
  // A perfect IMU averages the white part away; of the drift 10 s average 0.5 %.
  EXPECT_NEAR(expectation.curve().back().position_n_m.x(), 2.0, 0.02);
}

TEST(ExpectedErrors, NameWhatTheyLeaveOut) {
  ImuErrorProfile errors;
  errors.gyro.bandwidth_hz.setConstant(50.0);
  errors.accel.quantization_m_per_s.setConstant(1e-5);
  errors.drop_probability = 0.1;
  VibrationProfile shake;
  shake.linear.emplace_back();
  ExpectedErrors::Setup setup;
  setup.gravity = nav::Gravity(nav::GravityModel::Somigliana, {10.0, 0.0, 0.0});
  const ExpectedErrors expectation(setup, {errors, shake, FaultProfile{}});
  EXPECT_THAT(expectation.left_out(),
              testing::UnorderedElementsAre("bandwidth", "quantization", "dropped samples", "vibration of the output",
                                            "faults", "gravity disturbance"));
}

}  // namespace expected_errors_test
}  // namespace inslab::predict
