#include "inslab/foundation/host/outcome.hpp"

#include <gtest/gtest.h>

namespace inslab::host {
namespace outcome_test {

TEST(Outcome, TheWorseOfTwoIsTheWorseThingThatHappened) {
  const Outcome good{kOk, "44 of 44 checks held"}, limit{kNotAccepted, "FAIL: 1 of 2"}, check{kFailed, "2 lost"},
      input{kBadInput, "no such file"}, swap{kNotApplied, "rejected"};
  EXPECT_EQ(worse(good, limit).reason, "FAIL: 1 of 2");
  EXPECT_EQ(worse(limit, swap).reason, "FAIL: 1 of 2") << "a refused swap does not hide a missed limit";
  EXPECT_EQ(worse(limit, check).reason, "2 lost") << "a broken set puts the finding in doubt";
  EXPECT_EQ(worse(check, input).reason, "no such file");
  EXPECT_EQ(worse(check, {kFailed, "another"}).reason, "2 lost") << "the first of equals";
}

TEST(Outcome, SaysItsExitCodeAndWhy) {
  EXPECT_EQ(Outcome({kOk, "44 of 44 checks held"}).words(), "result: passed: 44 of 44 checks held");
  EXPECT_EQ(Outcome({kFailed, "2 lost"}).words(), "result: FAILED, exit code 1: 2 lost");
  EXPECT_EQ(Outcome({kNotAccepted, "FAIL: 1 of 2"}).words(), "result: NOT ACCEPTED, exit code 4: FAIL: 1 of 2");
}

}  // namespace outcome_test
}  // namespace inslab::host
