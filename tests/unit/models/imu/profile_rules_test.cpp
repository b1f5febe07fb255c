#include "inslab/data/catalog/profile_rules.hpp"

#include <gtest/gtest.h>

namespace inslab::imu {
namespace profile_rules_test {

template <class Profile>
std::string broken(const Profile& profile) {
  const auto found = catalog::violation(profile);
  return found ? found->path : "";
}

TEST(ProfileRules, DefaultProfilesBreakNone) {
  EXPECT_EQ(broken(ImuErrorProfile()), "");
  EXPECT_EQ(broken(VibrationProfile()), "");
  EXPECT_EQ(broken(InstallationProfile()), "");
  EXPECT_EQ(broken(GnssErrorProfile()), "");
  EXPECT_EQ(broken(FaultProfile()), "");
}

TEST(ProfileRules, ACorrelationTimeIsNeededWhereASigmaIs) {
  ImuErrorProfile profile;
  profile.gyro.bias_gm_sigma_deg_per_h = {0.0, 1.0, 0.0};
  EXPECT_EQ(broken(profile), "gyro.bias_gm_correlation_time_s[1]");
  profile.gyro.bias_gm_correlation_time_s.y() = 100.0;
  EXPECT_EQ(broken(profile), "");
  profile.accel.bias_gm_sigma_mgal.z() = 5.0;
  EXPECT_EQ(broken(profile), "accel.bias_gm_correlation_time_s[2]");
}

TEST(ProfileRules, ADriftingAngleHasItsCorrelationTime) {
  ImuErrorProfile profile;
  profile.gyro_cross_axis_gm_sigma_arcsec[4] = 1.0;
  EXPECT_EQ(broken(profile), "gyro_cross_axis_gm_correlation_time_s[4]");
  profile.gyro_cross_axis_gm_correlation_time_s[4] = 100.0;
  EXPECT_EQ(broken(profile), "");
  profile.accel_cross_axis_gm_sigma_arcsec[5] = 1.0;
  EXPECT_EQ(broken(profile), "accel_cross_axis_gm_correlation_time_s[5]");
}

TEST(ProfileRules, AnAccelerometerThatSaturatesReadsOneG) {
  ImuErrorProfile profile;
  profile.accel.full_scale_g = {1.0, 10.0, 0.0};
  EXPECT_EQ(broken(profile), "");
  profile.accel.full_scale_g.y() = 0.99;
  EXPECT_EQ(broken(profile), "accel.full_scale_g[1]");
}

TEST(ProfileRules, ANonlinearityInPartsOfFullScaleHasOne) {
  ImuErrorProfile profile;
  profile.gyro.nonlinearity_ppm_of_full_scale.z() = 10.0;
  EXPECT_EQ(broken(profile), "gyro.nonlinearity_ppm_of_full_scale[2]");
  profile.gyro.full_scale_deg_per_s.setConstant(400.0);
  EXPECT_EQ(broken(profile), "");
}

TEST(ProfileRules, TemperaturesAreInOrderOfTime) {
  ImuErrorProfile profile;
  profile.temperature = {{0.0, 20.0}, {10.0, 30.0}, {10.0, 40.0}};
  EXPECT_EQ(broken(profile), "temperature[2].at_s");
}

TEST(ProfileRules, ASpectrumSpansABandInOrderOfFrequency) {
  VibrationProfile profile;
  profile.linear_random = {{10.0, Vector3::Ones()}};
  EXPECT_EQ(broken(profile), "linear_random");
  profile.linear_random.push_back({5.0, Vector3::Ones()});
  EXPECT_EQ(broken(profile), "linear_random[1].frequency_hz");
  profile.linear_random[1].frequency_hz = 20.0;
  EXPECT_EQ(broken(profile), "");
}

TEST(ProfileRules, AMountMovesAtMostFiveCentimetresAndTwoDegrees) {
  const double pi = 3.14159265358979323846;
  VibrationProfile profile;
  profile.domain = VibrationDomain::Motion;
  profile.linear.push_back({Vector3(0.049 * 4 * pi * pi, 0.0, 0.0), 1.0, Vector3::Zero()});
  profile.angular.push_back({Vector3(1.9 * 2 * pi, 0.0, 0.0), 1.0, Vector3::Zero()});
  EXPECT_EQ(broken(profile), "");
  profile.linear.push_back({Vector3(0.0, 0.002 * 4 * pi * pi, 0.0), 1.0, Vector3::Zero()});
  EXPECT_EQ(broken(profile), "linear");
  profile.domain = VibrationDomain::Sensor;
  EXPECT_EQ(broken(profile), "");
}

TEST(ProfileRules, AMountMovesAtFrequenciesAndSinusoidsAlone) {
  VibrationProfile profile;
  profile.domain = VibrationDomain::Motion;
  profile.angular_random = {{10.0, Vector3::Ones()}, {20.0, Vector3::Ones()}};
  EXPECT_EQ(broken(profile), "angular_random");
  profile.angular_random.clear();
  profile.linear.push_back({Vector3::Ones(), 2001.0, Vector3::Zero()});
  EXPECT_EQ(broken(profile), "linear[0].frequency_hz");
}

TEST(ProfileRules, AProfileGoesToItsKindOfSensor) {
  ImuErrorProfile imu;
  imu.target.kind = SensorKind::Gnss;
  EXPECT_EQ(broken(imu), "target_kind");
  VibrationProfile vibration;
  vibration.target.kind = SensorKind::Gnss;
  EXPECT_EQ(broken(vibration), "target_kind");
  GnssErrorProfile gnss;
  gnss.target.kind = SensorKind::Imu;
  EXPECT_EQ(broken(gnss), "target_kind");
}

TEST(ProfileRules, AnAntennaHasNoMountingAngles) {
  InstallationProfile profile;
  profile.mounting_rpy_deg.z() = 1.0;
  EXPECT_EQ(broken(profile), "");
  profile.target.kind = SensorKind::Gnss;
  EXPECT_EQ(broken(profile), "mounting_rpy_deg");
}

TEST(ProfileRules, ALeverArmHasAtMostAKilometre) {
  InstallationProfile profile;
  profile.lever_arm_v_m = {1000.0, 0.0, 0.0};
  EXPECT_EQ(broken(profile), "");
  profile.lever_arm_v_m.y() = 1.0;
  EXPECT_EQ(broken(profile), "lever_arm_v_m");
}

TEST(ProfileRules, FaultsFitTheirSensor) {
  FaultProfile fault;
  fault.outage = true;
  EXPECT_EQ(broken(fault), "outage");
  fault.target.kind = SensorKind::Gnss;
  EXPECT_EQ(broken(fault), "");
  fault.gyro_bias_jump_deg_per_h.x() = 1.0;
  EXPECT_EQ(broken(fault), "gyro_bias_jump_deg_per_h");
  fault.gyro_bias_jump_deg_per_h.setZero();
  fault.accel_axes[1] = AxisFault::Stuck;
  EXPECT_EQ(broken(fault), "accel_fault_y");
  fault.accel_axes[1] = AxisFault::None;
  fault.gyro_silent = true;
  EXPECT_EQ(broken(fault), "gyro_silent");
  FaultProfile jump;
  jump.position_jump_ned_m.x() = 1.0;
  EXPECT_EQ(broken(jump), "position_jump_ned_m");
}

TEST(ProfileRules, OnlyVibrationFades) {
  VibrationProfile vibration;
  vibration.request.fade_s = 2.0;
  EXPECT_EQ(broken(vibration), "");
  ImuErrorProfile imu;
  imu.request.fade_s = 2.0;
  EXPECT_EQ(broken(imu), "request.fade_s");
}

TEST(ProfileRules, AReceiverWithoutAFixIsAnOutage) {
  GnssErrorProfile profile;
  profile.fix_type = FixType::None;
  EXPECT_EQ(broken(profile), "fix_type");
}

}  // namespace profile_rules_test
}  // namespace inslab::imu
