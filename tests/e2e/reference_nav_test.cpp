// The reference navigation app as one process of the set.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace reference_nav_test {

using std::chrono::seconds;
using testing::HasSubstr;

constexpr std::size_t kImuSamples = 2000;

std::vector<NavSolution> solutions_of(const std::string& log) {
  return samples_of_kind<NavSolution>(log, "inslab/nav");
}

TEST(ReferenceNav, AnswersEachImuSampleLiveAndIsAccepted) {
  const TestFolder folder;
  const std::string log = folder / "live.mcap";
  Process run("inslab", {"run", source("tests/data/reference_nav.json"), "--domain", own_domain(), "--log", log});
  ASSERT_EQ(run.wait(seconds(90)), 0) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("PASS  horizontal_rms_m, all, after 4 s, at most 1: "));
  const std::vector<NavSolution> solutions = solutions_of(log);
  ASSERT_EQ(solutions.size(), kImuSamples);
  for (std::size_t i = 0; i < solutions.size(); ++i) ASSERT_EQ(solutions[i].imu_sequence, i);
  EXPECT_EQ(solutions.front().mode, NavMode::Aligning);
  EXPECT_EQ(solutions.back().mode, NavMode::Navigating);
}

TEST(ReferenceNav, SaysHowFarItIs) {
  const TestFolder folder;
  const std::string log = folder / "log.mcap";
  Process run("inslab", {"run", source("tests/data/reference_nav.json"), "--domain", own_domain(), "--log", log,
                         "--clock", "lockstep"});
  ASSERT_EQ(run.wait(seconds(90)), 0) << run.output();
  std::int64_t last_ns = 0;
  for (const ServiceStatus& status : samples_of_kind<ServiceStatus>(log, "inslab/service_status")) {
    if (status.service == "inslab-reference-nav") last_ns = status.sim_time_ns;
  }
  EXPECT_EQ(last_ns, 10'000'000'000);
}

TEST(ReferenceNav, InLockstepItsSolutionsAreThoseOfTheOfflineRunToTheBit) {
  const TestFolder folder;
  const std::string scenario = source("tests/data/reference_nav.json"), log = folder / "lockstep.mcap";
  Process run("inslab", {"run", scenario, "--domain", own_domain(), "--log", log, "--clock", "lockstep"});
  ASSERT_EQ(run.wait(seconds(90)), 0) << run.output();
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  const std::vector<NavSolution> live = solutions_of(log);
  const std::vector<NavSolution> reference = solutions_of(folder / "offline/reference_nav.mcap");
  ASSERT_EQ(reference.size(), kImuSamples);
  ASSERT_EQ(live.size(), kImuSamples);
  std::vector<std::uint8_t> bytes, expected;
  for (std::size_t i = 0; i < kImuSamples; ++i) {
    wire::encode(live[i], bytes);
    wire::encode(reference[i], expected);
    ASSERT_EQ(bytes, expected) << "solution " << i;
  }
}

TEST(ReferenceNav, TakesPartInASecuredSetAsTheAppUnderTest) {
  const TestFolder folder;
  Process make_keys(source("deploy/security/make-keys"), {folder / "keys", "2"});
  ASSERT_EQ(make_keys.wait(seconds(60)), 0) << make_keys.output();
  Process run("inslab", {"run", source("tests/data/reference_nav.json"), "--domain", own_domain(), "--log",
                         folder / "secured.mcap", "--clock", "lockstep", "--security", folder / "keys"});
  ASSERT_EQ(run.wait(seconds(90)), 0) << run.output();
  EXPECT_EQ(solutions_of(folder / "secured.mcap").size(), kImuSamples);
}

}  // namespace reference_nav_test
}  // namespace inslab::e2e
