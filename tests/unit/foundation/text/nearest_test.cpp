#include "inslab/foundation/text/nearest.hpp"

#include <gtest/gtest.h>

namespace inslab::text {
namespace nearest_test {

const std::vector<std::string> kCommands{"run", "summary", "report", "simulate", "check", "plot"};

TEST(Nearest, FindsTheWordThatWasMeant) {
  EXPECT_EQ(nearest("runn", kCommands), "run");
  EXPECT_EQ(nearest("sumary", kCommands), "summary");
  EXPECT_EQ(nearest("chekc", kCommands), "check");
  EXPECT_EQ(nearest("Report", kCommands), "report");
}

TEST(Nearest, GuessesNothingThatIsFarOff) {
  EXPECT_EQ(nearest("fly", kCommands), "");
  EXPECT_EQ(nearest("", kCommands), "");
  EXPECT_EQ(nearest("xy", kCommands), "");
  EXPECT_EQ(nearest(std::string(1'000'000, 'r'), kCommands), "");
}

TEST(Nearest, TakesTheNearestOfSeveral) { EXPECT_EQ(nearest("plott", {"pilot", "plot"}), "plot"); }

TEST(Nearest, SaysItAsAQuestion) {
  EXPECT_EQ(did_you_mean("runn", kCommands), "; did you mean 'run'?");
  EXPECT_EQ(did_you_mean("fly", kCommands), "");
}

}  // namespace nearest_test
}  // namespace inslab::text
