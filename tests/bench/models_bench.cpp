#include <benchmark/benchmark.h>

#include "inslab/models/air_data/air_data_model.hpp"
#include "inslab/models/barometer/barometer_model.hpp"
#include "inslab/models/gnss/gnss_model.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/magnetometer/magnetometer_model.hpp"
#include "inslab/models/odometer/odometer_model.hpp"
#include "inslab/noise/random/stream.hpp"

/// Price of the models on one core. Goals: 12 ns a normal number, 3 M samples/s of an IMU with bias and noise, 1 M of
/// one with every term.
namespace inslab::bench {
namespace {

constexpr std::int64_t kPeriodNs = 5000000;

/// A turning, climbing car at 200 Hz; what the models make of it costs the same as any other truth.
TruthState truth_sample(std::int64_t k) {
  TruthState truth;
  truth.header.sim_time_ns = k * kPeriodNs;
  truth.interval_ns = k == 0 ? 0 : kPeriodNs;
  truth.latitude_rad = 0.53;
  truth.longitude_rad = 2.0 + 1e-9 * static_cast<double>(k % 1000);
  truth.height_m = 20.0;
  truth.v_n = {10.0, 5.0, -1.0};
  truth.q_nv = Quaternion(0.9, 0.1, 0.2, 0.3).normalized();
  truth.omega_iv_v = {0.01, 0.02, 0.3};
  truth.f_v = {0.1, 0.2, -9.8};
  truth.dtheta_v = truth.omega_iv_v * 5e-3;
  truth.dv_v = truth.f_v * 5e-3;
  return truth;
}

ImuErrorProfile bias_and_noise() {
  ImuErrorProfile profile;
  profile.gyro.bias_gm_sigma_deg_per_h = Vector3::Constant(0.5);
  profile.gyro.bias_gm_correlation_time_s = Vector3::Constant(3600.0);
  profile.gyro.arw_deg_per_sqrt_h = Vector3::Constant(0.15);
  profile.accel.bias_gm_sigma_mgal = Vector3::Constant(50.0);
  profile.accel.bias_gm_correlation_time_s = Vector3::Constant(3600.0);
  profile.accel.vrw_m_per_s_per_sqrt_h = Vector3::Constant(0.07);
  return profile;
}

imu::ImuModel::Setup imu_setup() {
  imu::ImuModel::Setup setup{1, 0, time::Rate(200.0), nav::Gravity(), {}, {}, {}};
  setup.errors = bias_and_noise();
  return setup;
}

void run_imu(benchmark::State& state, imu::ImuModel& model) {
  std::int64_t k = 0;
  model.measure(truth_sample(k));
  for (auto _ : state) {
    auto output = model.measure(truth_sample(++k));
    benchmark::DoNotOptimize(output);
  }
  state.SetItemsProcessed(state.iterations());
}

void BM_Normal(benchmark::State& state) {
  random::NormalCursor cursor(random::Stream(1, "bench"));
  std::uint64_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(cursor.at(k++));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_Normal);

void BM_ImuPerfect(benchmark::State& state) {
  auto setup = imu_setup();
  setup.errors = {};
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuPerfect);

void BM_ImuBiasAndNoise(benchmark::State& state) {
  imu::ImuModel model(imu_setup());
  run_imu(state, model);
}
BENCHMARK(BM_ImuBiasAndNoise);

void BM_ImuLeverArm(benchmark::State& state) {
  auto setup = imu_setup();
  setup.installation.lever_arm_v_m = {0.5, 0.2, -0.8};
  setup.installation.mounting_rpy_deg = {1.0, 2.0, 3.0};
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuLeverArm);

template <class Errors>
void add_every_common_term(Errors& errors) {
  errors.scale_factor_ppm.setConstant(10.0);
  errors.scale_factor_turn_on_sigma_ppm.setConstant(10.0);
  errors.scale_factor_gm_sigma_ppm.setConstant(10.0);
  errors.scale_factor_gm_correlation_time_s.setConstant(1000.0);
  errors.scale_factor_temperature_ppm_per_deg_c.setConstant(1.0);
  errors.scale_factor_asymmetry_ppm.setConstant(5.0);
  errors.nonlinearity_ppm_of_full_scale.setConstant(5.0);
  errors.cross_axis_arcsec.setConstant(30.0);
  errors.bandwidth_hz.setConstant(50.0);
  errors.bandwidth_order = FilterOrder::Second;
}

/// Every error term: deterministic, random, and limits.
ImuErrorProfile every_error() {
  ImuErrorProfile errors = bias_and_noise();
  add_every_common_term(errors.gyro);
  add_every_common_term(errors.accel);
  for (auto* vector : {&errors.gyro.bias_constant_deg_per_h, &errors.gyro.bias_turn_on_sigma_deg_per_h,
                       &errors.gyro.bias_random_walk_deg_per_h_per_sqrt_h, &errors.gyro.bias_instability_deg_per_h,
                       &errors.gyro.bias_temperature_deg_per_h_per_deg_c, &errors.accel.bias_constant_mgal,
                       &errors.accel.bias_turn_on_sigma_mgal, &errors.accel.bias_random_walk_mgal_per_sqrt_h,
                       &errors.accel.bias_instability_mgal, &errors.accel.bias_temperature_mgal_per_deg_c,
                       &errors.accel.nonlinearity_ppm_per_g, &errors.accel.full_scale_g}) {
    vector->setConstant(10.0);
  }
  errors.gyro.g_sensitivity_deg_per_h_per_g.setConstant(1.0);
  errors.gyro.full_scale_deg_per_s.setConstant(400.0);
  errors.gyro.quantization_arcsec.setConstant(0.1);
  errors.accel.quantization_m_per_s.setConstant(1e-5);
  errors.temperature = {{0.0, 20.0}, {1e6, 60.0}};
  errors.drop_probability = 1e-3;
  return errors;
}

void BM_ImuEveryError(benchmark::State& state) {
  auto setup = imu_setup();
  setup.errors = every_error();
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuEveryError);

void shake(VibrationProfile& vibration) {
  for (const double frequency_hz : {12.0, 30.0, 85.0}) {
    vibration.linear.push_back({Vector3::Constant(0.3), frequency_hz, Vector3(0.0, 90.0, 45.0)});
    vibration.angular.push_back({Vector3::Constant(0.3), frequency_hz, Vector3(0.0, 90.0, 45.0)});
  }
}

/// Arm, mounting, three linear and three angular sinusoids, every error.
void BM_ImuEveryTerm(benchmark::State& state) {
  auto setup = imu_setup();
  setup.errors = every_error();
  setup.installation.lever_arm_v_m = {0.5, 0.2, -0.8};
  setup.installation.mounting_rpy_deg = {1.0, 2.0, 3.0};
  shake(setup.vibration);
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuEveryTerm);

/// Everything that an IMU's profile can say.
ImuErrorProfile every_stage() {
  ImuErrorProfile errors = every_error();
  errors.accel_delay_s = 0.001;
  errors.accel_place_m.setConstant(0.01);
  errors.gyro_cross_axis_gm_sigma_arcsec.setConstant(10.0);
  errors.gyro_cross_axis_gm_correlation_time_s.setConstant(100.0);
  errors.accel_cross_axis_gm_sigma_arcsec.setConstant(10.0);
  errors.accel_cross_axis_gm_correlation_time_s.setConstant(100.0);
  errors.gyro_bias_temperature_rate_deg_per_h_per_deg_c_per_min.setConstant(1.0);
  errors.accel_bias_temperature_rate_mgal_per_deg_c_per_min.setConstant(1.0);
  errors.gyro_bias_hysteresis_deg_per_h.setConstant(1.0);
  errors.accel_bias_hysteresis_mgal.setConstant(1.0);
  errors.accel_rectification_mgal_per_g2.setConstant(10.0);
  errors.gyro_g2_sensitivity_deg_per_h_per_g2.setConstant(0.1);
  errors.gyro_anisoelasticity_deg_per_h_per_g2.setConstant(0.1);
  errors.gyro_anisoinertia_deg_per_h_per_deg2_per_s2.setConstant(1e-4);
  errors.time_tag.offset_s = 1e-3;
  errors.time_tag.drift_ppm = 1.0;
  errors.time_tag.white_sigma_s = 1e-6;
  errors.time_tag.gm_sigma_s = 1e-6;
  errors.time_tag.gm_correlation_time_s = 10.0;
  errors.time_tag.quantization_s = 1e-6;
  return errors;
}

void BM_ImuEveryStage(benchmark::State& state) {
  auto setup = imu_setup();
  setup.errors = every_stage();
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuEveryStage);

void BM_ImuEveryStageShaken(benchmark::State& state) {
  auto setup = imu_setup();
  setup.errors = every_stage();
  setup.installation.lever_arm_v_m = {0.5, 0.2, -0.8};
  setup.installation.mounting_rpy_deg = {1.0, 2.0, 3.0};
  shake(setup.vibration);
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuEveryStageShaken);

/// Random vibration along and about three axes beside bias and noise.
void BM_ImuRandomVibration(benchmark::State& state) {
  auto setup = imu_setup();
  setup.vibration.linear_random = {{10.0, Vector3::Constant(0.01)}, {500.0, Vector3::Constant(0.01)}};
  setup.vibration.angular_random = {{10.0, Vector3::Constant(0.01)}, {500.0, Vector3::Constant(0.01)}};
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuRandomVibration);

/// The same sinusoids as motion of the mount.
void BM_ImuMovingMount(benchmark::State& state) {
  auto setup = imu_setup();
  shake(setup.vibration);
  setup.vibration.domain = VibrationDomain::Motion;
  imu::ImuModel model(setup);
  run_imu(state, model);
}
BENCHMARK(BM_ImuMovingMount);

void BM_GnssFix(benchmark::State& state) {
  gnss::GnssModel::Setup setup{1, 0, time::Rate(200.0), {}, {}, {}, {}};
  setup.errors.position_sigma_ned_m.setConstant(1.0);
  setup.errors.velocity_sigma_ned_m_per_s.setConstant(0.1);
  setup.installation.target.kind = SensorKind::Gnss;
  setup.installation.lever_arm_v_m = {0.5, 0.2, -1.5};
  gnss::GnssModel model(setup);
  std::int64_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.observe(truth_sample(++k)));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_GnssFix);

/// Mounting, iron, noise, drift, counts, on a vehicle that drives at 11 m/s: the Earth's field of a cell of the World
/// Magnetic Model is asked for anew as often as it is then.
void BM_Magnetometer(benchmark::State& state) {
  magnetometer::MagnetometerModel::Setup setup{1, 0, time::Rate(200.0), {}, {}};
  setup.errors.hard_iron_nt = {500.0, -300.0, 200.0};
  setup.errors.soft_iron.setConstant(0.01);
  setup.errors.white_sigma_nt.setConstant(15.0);
  setup.errors.gm_sigma_nt.setConstant(20.0);
  setup.errors.gm_correlation_time_s.setConstant(600.0);
  setup.errors.quantization_nt.setConstant(13.0);
  setup.installation.target.kind = SensorKind::Magnetometer;
  magnetometer::MagnetometerModel model(setup);
  TruthState truth = truth_sample(0);
  truth.header.gps_week = 2446;
  const double step_rad = 11.0 * 5e-3 / 6.4e6;
  std::int64_t k = 0;
  for (auto _ : state) {
    truth.header.sim_time_ns = ++k * kPeriodNs;
    truth.interval_ns = kPeriodNs;
    truth.latitude_rad = 0.53 + step_rad * static_cast<double>(k % 20'000'000);
    benchmark::DoNotOptimize(model.observe(truth));
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_Magnetometer);

/// Arm, drifting air, static error, lag, noise, drift, counts.
void BM_Barometer(benchmark::State& state) {
  barometer::BarometerModel::Setup setup{1, 0, time::Rate(200.0), {}, {}};
  setup.errors.sea_level_pressure_gm_sigma_pa = 30.0;
  setup.errors.sea_level_pressure_gm_correlation_time_s = 7200.0;
  setup.errors.static_pressure_coefficient = 0.1;
  setup.errors.time_constant_s = 0.05;
  setup.errors.white_sigma_pa = 1.0;
  setup.errors.gm_sigma_pa = 3.0;
  setup.errors.gm_correlation_time_s = 1800.0;
  setup.errors.quantization_pa = 0.3;
  setup.installation.target.kind = SensorKind::Barometer;
  setup.installation.lever_arm_v_m = {1.9, 0.3, -0.5};
  barometer::BarometerModel model(setup);
  std::int64_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.observe(truth_sample(++k)));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_Barometer);

/// Boom, wind of a table, gusts, static error, lags, noise and drift of pressures and vanes, counts, and what the
/// computer makes of them.
void BM_AirData(benchmark::State& state) {
  air_data::AirDataModel::Setup setup{1, 0, time::Rate(200.0), {}, {}};
  setup.errors.wind.levels = {{10.0, {4.0, 3.0, 0.0}}, {3000.0, {9.0, 15.0, 0.0}}};
  setup.errors.wind.turbulence = Turbulence::Moderate;
  setup.errors.static_pressure_coefficient = 0.03;
  setup.errors.pitot_time_constant_s = 0.02;
  setup.errors.static_time_constant_s = 0.04;
  setup.errors.impact_pressure = {4000.0, 15.0, 1.5, 3.0, 600.0, -6895.0, 6895.0, 1.05};
  setup.errors.static_pressure = {0.0, -90.0, 2.7, 6.0, 900.0, 1000.0, 120000.0, 1.0};
  setup.errors.temperature_white_sigma_deg_c = 0.1;
  setup.errors.angle_of_attack = {0.08, 0.0, 0.3, 0.15, 0.1, 300.0, 30.0, 0.088};
  setup.errors.angle_of_sideslip = {0.0, 0.0, -0.2, 0.15, 0.1, 300.0, 30.0, 0.088};
  setup.installation.target.kind = SensorKind::AirData;
  setup.installation.lever_arm_v_m = {2.8, 0.0, 0.1};
  air_data::AirDataModel model(setup);
  std::int64_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.observe(truth_sample(++k)));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_AirData);

/// Arm, misalignment, scale, slip, road, counts.
void BM_Odometer(benchmark::State& state) {
  odometer::OdometerModel::Setup setup{1, 0, time::Rate(200.0), {}, {}};
  setup.errors.scale_factor_gm_sigma_ppm = 300.0;
  setup.errors.scale_factor_gm_correlation_time_s = 1800.0;
  setup.errors.tyre_warming_ppm = -1500.0;
  setup.errors.noise_m_per_sqrt_m = 0.002;
  setup.errors.longitudinal_slip_threshold_m_per_s2 = 2.0;
  setup.errors.longitudinal_slip_s2_per_m = 0.01;
  setup.errors.counts_per_revolution = 1024.0;
  setup.installation.target.kind = SensorKind::Odometer;
  setup.installation.lever_arm_v_m = {0.0, -0.78, 0.31};
  setup.installation.mounting_rpy_deg = {0.0, 0.0, 0.15};
  odometer::OdometerModel model(setup);
  std::int64_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(model.measure(truth_sample(++k)));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BM_Odometer);

}  // namespace
}  // namespace inslab::bench
