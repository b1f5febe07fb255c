#include "inslab/referee/evidence/evidence_uses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/catalog/profile_kinds.hpp"

namespace inslab::evidence {
namespace profile_uses_test {

// A new term of a profile is handled, or it is named as left out: there is no third.
TEST(WeighedProfiles, SaysOfEveryFieldOfEveryProfileWhatBecomesOfIt) {
  const std::string file = "common/referee/evidence/evidence_uses.hpp";
  for_each(catalog::ProfileKinds{}, [&file](auto kind) {
    EXPECT_EQ(profiles::faults_of<typename decltype(kind)::type>(uses_of(kind), file), "");
  });
}

TEST(WeighedProfiles, NameWhatIsSetAndNoLineWeighs) {
  ImuErrorProfile errors;
  errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  EXPECT_TRUE(names_left_out(errors).empty());
  errors.gyro.bias_turn_on_sigma_deg_per_h.setConstant(1.0);
  errors.accel.bias_constant_mgal.setConstant(1.0);
  errors.latency_s = 0.01;
  EXPECT_THAT(names_left_out(errors), testing::ElementsAre("biases", "latency"));
  InstallationProfile turned;
  turned.mounting_rpy_deg.z() = 1.0;
  EXPECT_THAT(names_left_out(turned), testing::ElementsAre("mounting angles"));
}

}  // namespace profile_uses_test
}  // namespace inslab::evidence
