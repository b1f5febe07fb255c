#include "inslab/referee/predict/profile_uses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/profiles/any_profile.hpp"

namespace inslab::predict {
namespace profile_uses_test {

// A new term of a profile is handled, or it is named as left out: there is no third.
TEST(PredictedProfiles, SaysOfEveryFieldOfEveryProfileWhatBecomesOfIt) {
  const std::string file = "common/referee/predict/profile_uses.hpp";
  EXPECT_EQ(profiles::faults_of<ImuErrorProfile>(kImuErrorUses, file), "");
  EXPECT_EQ(profiles::faults_of<GnssErrorProfile>(kGnssErrorUses, file), "");
  EXPECT_EQ(profiles::faults_of<InstallationProfile>(kInstallationUses, file), "");
  EXPECT_EQ(profiles::faults_of<VibrationProfile>(kSensorVibrationUses, file), "");
  EXPECT_EQ(profiles::faults_of<FaultProfile>(kFaultUses, file), "");
}

}  // namespace profile_uses_test
}  // namespace inslab::predict
