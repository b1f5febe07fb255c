#include "inslab/services/inslab/study/verifications.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace inslab::study {
namespace verifications_test {

/// Faults are planted for the rows of each in tests/statistical/verify_motion_faults_test.cpp and
/// verify_noise_faults_test.cpp, of raw_gnss, which needs data from elsewhere, in
/// tests/unit/referee/verify/raw_gnss_test.cpp: a block that is added here is added there.
TEST(Verifications, AreTheBlocksForWhoseRowsFaultsArePlanted) {
  std::vector<std::string> names;
  for (const Verification& verification : verifications()) names.emplace_back(verification.name);
  EXPECT_THAT(names,
              testing::UnorderedElementsAre("trajectory", "closed-loop", "alignment", "allan", "increments", "gnss",
                                            "navigation", "realism", "propagation", "vibration", "raw_gnss"));
}

}  // namespace verifications_test
}  // namespace inslab::study
