#include "samples/profile_rules.hpp"

#include <gtest/gtest.h>

namespace inslab {
namespace {

template <class Profile>
std::string broken(const Profile& profile) {
  const auto found = violation(profile);
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

}  // namespace
}  // namespace inslab
