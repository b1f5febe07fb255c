// The reference navigation app as one process of the set.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <map>
#include <memory>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/service/service.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace reference_nav_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

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

TEST(ReferenceNav, InLockstepItsSolutionsAndTheStreamsAreShownToWhoListensAndNobodyWaitsForThat) {
  const TestFolder folder;
  service::NetworkOptions network;
  network.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
  dds::ParticipantOptions onlooker = service::participant_options(network, "onlooker");
  onlooker.looks_on = true;
  dds::Participant participant(onlooker);
  std::atomic<int> came_singly{0};
  const dds::Reader<ImuSample> singles(participant, dds::topics::stream<ImuSample>(0),
                                       [&came_singly](const ImuSample&, const dds::SampleOrigin&) { ++came_singly; });
  Process run("inslab", {"run", source("tests/data/reference_nav.json"), "--domain", own_domain(), "--log",
                         folder / "log.mcap", "--clock", "lockstep", "--paused"});
  Process ready("inslab", {"pause", "--domain", own_domain(), "--timeout", "60"});
  ASSERT_EQ(ready.wait(seconds(60)), 0) << ready.output() << run.output();
  const auto listen = [](const std::string& topic, const std::string& how, std::vector<std::string> more) {
    more.insert(more.begin(), {"topics", how, topic, "--domain", own_domain()});
    return std::make_unique<Process>("inslab", more);
  };
  const auto nav = listen("inslab/nav", "echo", {"--count", "5"});
  const auto imu = listen("inslab/imu/0", "echo", {"--count", "5"});
  const auto truth = listen("inslab/truth", "hz", {"--count", "20", "--seconds", "60"});
  const auto stopped = listen("inslab/imu/0", "echo", {});
  for (const auto* each : {&nav, &imu, &truth, &stopped}) {
    ASSERT_TRUE((*each)->prints("its writer is there and sends none", seconds(60))) << (*each)->output();
  }
  stopped->send(SIGSTOP);
  ASSERT_EQ(singles.matched_writers(), 1);
  Process resume("inslab", {"resume", "--domain", own_domain(), "--timeout", "60"});
  ASSERT_EQ(resume.wait(seconds(60)), 0) << resume.output() << run.output();
  EXPECT_EQ(run.wait(seconds(90)), 0) << run.output();
  EXPECT_THAT(run.output(), Not(HasSubstr("no longer waits")));
  EXPECT_EQ(nav->wait(seconds(10)), 0) << nav->output();
  EXPECT_THAT(nav->output(), HasSubstr("imu_sequence: 4\n"));
  EXPECT_EQ(imu->wait(seconds(10)), 0) << imu->output();
  EXPECT_THAT(imu->output(), HasSubstr("header.sequence_number: 4\n"));
  EXPECT_EQ(truth->wait(seconds(10)), 0) << truth->output();
  EXPECT_THAT(truth->output(), HasSubstr(" Hz over 19 intervals"));
  EXPECT_EQ(came_singly, 0) << "for listeners alone, which would cost each service a message for each sample";
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

/// That the app's solutions in lockstep and those of `inslab navigate` on the log are the offline run's.
void same_bits_in_lockstep_and_offline(const std::string& name) {
  const TestFolder folder;
  const std::string scenario = source("tests/data/" + name + ".json"), log = folder / "lockstep.mcap";
  Process run("inslab", {"run", scenario, "--domain", own_domain(), "--log", log, "--clock", "lockstep"});
  ASSERT_EQ(run.wait(seconds(90)), 0) << run.output();
  Process offline("inslab", {"simulate", scenario, "-o", folder / "offline"});
  ASSERT_EQ(offline.wait(seconds(60)), 0) << offline.output();
  const std::vector<NavSolution> live = solutions_of(log);
  const std::vector<NavSolution> reference = solutions_of(folder / ("offline/" + name + ".mcap"));
  ASSERT_EQ(reference.size(), kImuSamples);
  ASSERT_EQ(live.size(), kImuSamples);
  std::vector<std::uint8_t> bytes, expected;
  for (std::size_t i = 0; i < kImuSamples; ++i) {
    wire::encode(live[i], bytes);
    wire::encode(reference[i], expected);
    ASSERT_EQ(bytes, expected) << "solution " << i;
  }
}

TEST(ReferenceNav, InLockstepItsSolutionsAreThoseOfTheOfflineRunToTheBit) {
  same_bits_in_lockstep_and_offline("reference_nav");
}

TEST(ReferenceNav, InLockstepItWaitsForASensorThatItsScenarioGivesItBesides) {
  same_bits_in_lockstep_and_offline("reference_nav_magnetometer");
  same_bits_in_lockstep_and_offline("reference_nav_aided");
}

/// How many samples of each stream the app took in a live run.
std::map<std::string, std::uint64_t> taken_live(const std::string& name) {
  const TestFolder folder;
  const std::string log = folder / "live.mcap";
  Process run("inslab", {"run", source("tests/data/" + name + ".json"), "--domain", own_domain(), "--log", log});
  EXPECT_EQ(run.wait(seconds(90)), 0) << run.output();
  std::map<std::string, std::uint64_t> samples;
  for (const ServiceStatus& status : samples_of_kind<ServiceStatus>(log, "inslab/service_status")) {
    if (status.service != "inslab-reference-nav") continue;
    for (const StreamStatus& stream : status.streams) samples[stream.topic] = stream.samples;
  }
  return samples;
}

TEST(ReferenceNav, TakesOtherSensorsLive) {
  EXPECT_EQ(taken_live("reference_nav_magnetometer")["inslab/magnetometer/3"], 1000U);
  auto aided = taken_live("reference_nav_aided");
  EXPECT_EQ(aided["inslab/barometer/2"], 500U);
  EXPECT_EQ(aided["inslab/odometer/1"], 1000U);
  EXPECT_EQ(aided["inslab/odometer/4"], 300U);
  EXPECT_EQ(aided["inslab/heading/5"], 100U);
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
