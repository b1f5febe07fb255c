#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/referee/predict/predict_uses.hpp"

namespace inslab::predict {
namespace profile_uses_test {

// A new term of a profile is handled, or it is named as left out: there is no third.
TEST(PredictedProfiles, SaysOfEveryFieldOfEveryProfileWhatBecomesOfIt) {
  const std::string file = "common/referee/predict/predict_uses.hpp";
  for_each(catalog::ProfileKinds{}, [&file](auto kind) {
    EXPECT_EQ(profiles::faults_of<typename decltype(kind)::type>(uses_of(kind), file), "");
  });
}

}  // namespace profile_uses_test
}  // namespace inslab::predict
