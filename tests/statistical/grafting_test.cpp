#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/nav/strapdown.hpp"
#include "inslab/nav/wgs84.hpp"

/// A recording of a simulated IMU, grafted onto the perfect one, drifts as the IMU itself does.
namespace inslab::imu {
namespace grafting_test {

constexpr std::int64_t kPeriodNs = 10'000'000;
constexpr int kOutageSamples = 6000;  // 60 s

/// A vehicle at rest, levelled and pointing north, one sample after another.
class AtRest {
 public:
  AtRest() {
    const nav::Geodetic place{0.7, 0.2, 50.0};
    const double dt_s = time::to_seconds(kPeriodNs);
    truth_.latitude_rad = place.latitude_rad;
    truth_.longitude_rad = place.longitude_rad;
    truth_.height_m = place.height_m;
    truth_.omega_iv_v =
        nav::wgs84::omega_e_rad_per_s * Vector3(std::cos(place.latitude_rad), 0.0, -std::sin(place.latitude_rad));
    truth_.f_v = -gravity.g_n(place);
    truth_.dtheta_v = truth_.omega_iv_v * dt_s;
    truth_.dv_v = truth_.f_v * dt_s;
  }
  TruthState next() {
    TruthState truth = truth_;
    truth.header.sim_time_ns = kPeriodNs * samples_;
    truth.interval_ns = samples_ == 0 ? 0 : kPeriodNs;
    ++samples_;
    return truth;
  }
  nav::NavState state() const {
    return {{truth_.latitude_rad, truth_.longitude_rad, truth_.height_m}, Vector3::Zero(), Quaternion::Identity()};
  }

  nav::Gravity gravity;

 private:
  TruthState truth_;
  std::int64_t samples_ = 0;
};

/// Errors that forget within half a minute, so that an hour holds many of them.
ImuErrorProfile parametric() {
  ImuErrorProfile profile;
  profile.gyro.arw_deg_per_sqrt_h.setConstant(0.15);
  profile.gyro.bias_gm_sigma_deg_per_h.setConstant(20.0);
  profile.gyro.bias_gm_correlation_time_s.setConstant(30.0);
  profile.accel.vrw_m_per_s_per_sqrt_h.setConstant(0.07);
  profile.accel.bias_gm_sigma_mgal.setConstant(50.0);
  profile.accel.bias_gm_correlation_time_s.setConstant(30.0);
  return profile;
}

ImuModel::Setup setup_of(std::uint64_t seed, const ImuErrorProfile& profile) {
  ImuModel::Setup setup{seed, 0, time::Rate(100.0), nav::Gravity(), profile, {}, {}};
  setup.end = time::Nanoseconds(kPeriodNs * kOutageSamples);
  return setup;
}

/// North and east drift of free inertial navigation after 60 s from the true state, m.
Eigen::Vector2d drift(const ImuModel::Setup& setup) {
  AtRest vehicle;
  ImuModel model(setup);
  model.measure(vehicle.next());
  nav::Strapdown strapdown(vehicle.state(), vehicle.gravity, {});
  for (int k = 0; k < kOutageSamples; ++k) {
    const auto output = model.measure(vehicle.next());
    strapdown.advance({output->sample.dtheta_b, output->sample.dv_b, 0.01});
  }
  const nav::Geodetic was = vehicle.state().position, is = strapdown.position();
  constexpr double kRadius_m = 6.37e6;
  return {(is.latitude_rad - was.latitude_rad) * kRadius_m,
          (is.longitude_rad - was.longitude_rad) * kRadius_m * std::cos(was.latitude_rad)};
}

double rms_drift_m(int seeds, const ImuErrorProfile& profile, const RecordingFinder& find) {
  double squares = 0.0;
  for (int seed = 1; seed <= seeds; ++seed) {
    ImuModel::Setup setup = setup_of(static_cast<std::uint64_t>(seed), profile);
    setup.recordings = find;
    squares += drift(setup).squaredNorm();
  }
  return std::sqrt(squares / seeds);
}

TEST(Grafting, ARecordingOfAnHourDriftsAsItsProfileDoes) {
  auto recording = std::make_shared<RecordedErrors>();
  recording->rate = time::Rate(100.0);
  AtRest vehicle;
  ImuModel model(setup_of(777, parametric()));
  model.measure(vehicle.next());
  for (int k = 0; k < 360'000; ++k) {
    const auto output = model.measure(vehicle.next());
    const Vector3 theta = output->truth.gyro_error.sum(), v = output->truth.accel_error.sum();
    recording->intervals.push_back({theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z()});
  }
  ImuErrorProfile grafted;
  grafted.recorded_error.file = "hour.mcap";
  grafted.recorded_error.sha256 = std::string(64, '0');
  const auto find = [&](const std::string&, const std::string&) { return recording; };

  const double of_profile_m = rms_drift_m(200, parametric(), {});
  const double of_recording_m = rms_drift_m(20, grafted, find);
  // The mean square of 20 drifts of two components each: chi-square of 40 degrees of freedom, 95 %: 24.43 to 59.34.
  EXPECT_GT(of_recording_m, of_profile_m * std::sqrt(24.43 / 40.0));
  EXPECT_LT(of_recording_m, of_profile_m * std::sqrt(59.34 / 40.0));
  RecordProperty("profile_m", std::to_string(of_profile_m));
  RecordProperty("recording_m", std::to_string(of_recording_m));
}

}  // namespace grafting_test
}  // namespace inslab::imu
