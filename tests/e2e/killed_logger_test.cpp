// A logger that is killed while the app goes on answering.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/data/streams/identity.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/running_set.hpp"

namespace inslab::e2e {
namespace killed_logger_test {

using std::chrono::seconds;
using testing::HasSubstr;

class KilledLogger : public RunningSet {
 protected:
  std::vector<NavSolution> solutions() const { return samples_of_kind<NavSolution>(log_, "inslab/nav"); }
  std::set<std::uint64_t> answered() const {
    std::set<std::uint64_t> sequences;
    for (const NavSolution& solution : solutions()) sequences.insert(solution.imu_sequence);
    return sequences;
  }
  /// What the log says of the messages of a topic that it lacks; empty: nothing.
  std::string missing(const std::string& topic) const {
    const mcap::McapReader log(log_);
    for (const mcap::Metadata& record : log.metadata()) {
      if (record.values.count("missing_messages") > 0 && record.values.at("what") == topic) {
        return record.values.at("missing_messages");
      }
    }
    return "";
  }
};

/// What the processes of the set have in common, as one of them says.
std::optional<streams::Identity> identity_heard(const dds::Participant& participant) {
  for (const dds::Peer& peer : participant.peers().all()) {
    if (auto identity = streams::identity_in(peer.user_data)) return identity;
  }
  return std::nullopt;
}

/// A participant that the others take for a service of their set, on another host.
std::unique_ptr<dds::Participant> in_the_place_of(const std::string& service, streams::Identity identity) {
  service::NetworkOptions network;
  network.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
  identity.service = service;
  identity.process_space.clear();
  return std::make_unique<dds::Participant>(service::participant_options(network, identity));
}

/// The stream comes with two gaps, and after the kill it is sent again from the first of them on, as it is asked for.
TEST_F(KilledLogger, HasEachSampleOnceWhenItWasKilledWhileSomeWereMissing) {
  const auto logger = [this] { return service("inslab-truth-logger", "recovery_by_hand", {"--log", log_}); };
  auto log = logger();
  ASSERT_TRUE(eventually([this] { return identity_heard(participant_).has_value(); }, seconds(20))) << log->output();
  const streams::Identity identity = *identity_heard(participant_);
  const auto server = in_the_place_of("inslab-trajectory-server", identity);
  const auto injector = in_the_place_of("inslab-imu-injector", identity);
  dds::Writer<SimStatus> statuses(*server, dds::topics::sim_status());
  dds::Writer<ImuSample> samples(*injector, dds::topics::stream<ImuSample>(0, 200.0));
  SimStatus status;
  status.run_id.bytes.fill(7);
  status.state = RunState::Running;
  const auto send = [&](std::uint64_t first, std::uint64_t last) {
    ImuSample sample;
    sample.header.run_id = status.run_id;
    for (std::uint64_t number = first; number <= last; ++number) {
      sample.header.sequence_number = number;
      EXPECT_TRUE(samples.write(sample));
    }
    EXPECT_TRUE(samples.wait_for_acknowledgments(seconds(10)));
  };
  std::atomic<int> asked{0};
  const dds::Reader<Credit> credits(participant_, dds::topics::credit(),
                                    [&asked](const Credit& credit, const dds::SampleOrigin&) {
                                      asked += credit.topic == "inslab/imu/0" && credit.next_sequence == 20 ? 1 : 0;
                                    });
  const auto is_heard = [&] {
    EXPECT_TRUE(statuses.write(status));
    return samples.matched_readers() > 0;
  };
  // What it says of itself is written after what it has heard: with every flush the log grows.
  const auto flushes = [&] {
    const auto before = std::filesystem::file_size(log_);
    return eventually(
        [&] {
          EXPECT_TRUE(statuses.write(status));
          return std::filesystem::file_size(log_) > before;
        },
        seconds(10));
  };

  ASSERT_TRUE(eventually(is_heard, seconds(20))) << log->output();
  send(0, 19);
  send(30, 59);
  send(70, 99);
  ASSERT_TRUE(eventually([&] { return asked > 0; }, seconds(20))) << log->output();
  // The first flush may have begun before the last sample came.
  ASSERT_TRUE(flushes() && flushes() && flushes()) << log->output();
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(10)), 128 + SIGKILL);
  ASSERT_TRUE(eventually([&] { return samples.matched_readers() == 0; }, seconds(60)));
  asked = 0;
  log = logger();
  ASSERT_TRUE(eventually(is_heard, seconds(20))) << log->output();
  ASSERT_TRUE(eventually([&] { return asked > 0; }, seconds(20))) << log->output();
  send(20, 119);
  status.state = RunState::Stopped;
  EXPECT_TRUE(statuses.write(status));
  EXPECT_TRUE(log->wait(seconds(60))) << log->output();
  std::map<std::uint64_t, int> times;
  for (const auto& sample : samples_of_kind<ImuSample>(log_, "inslab/imu/0")) ++times[sample.header.sequence_number];
  EXPECT_EQ(times.size(), 120u);
  for (const auto& [number, count] : times) EXPECT_EQ(count, 1) << "sample " << number;
}

/// What a logger leaves that is killed while it flushes: more in the log than in what it keeps of itself.
TEST_F(KilledLogger, HasEachSampleOnceWhenTheLogHasMoreThanItsStateKnows) {
  const auto logger = [this] { return service("inslab-truth-logger", "recovery_long", {"--log", log_}); };
  const auto copy = [](const std::string& from, const std::string& to) {
    for (const auto& entry : std::filesystem::directory_iterator(from)) {
      if (entry.path().filename().string().rfind("inslab-truth-logger", 0) != 0) continue;
      std::filesystem::copy(entry.path(), to, std::filesystem::copy_options::overwrite_existing);
    }
  };
  auto log = logger();
  const auto imu = service("inslab-imu-injector", "recovery_long");
  const auto gnss = service("inslab-gnss-emulator", "recovery_long");
  const auto truth = service("inslab-trajectory-server", "recovery_long", {"--clock", "real_time", "--rate", "2"});
  ASSERT_TRUE(reaches(1.0)) << truth->output();
  log->send(SIGSTOP);
  std::filesystem::create_directory(folder_ / "kept");
  copy(folder_ / "state", folder_ / "kept");
  const auto size_then = std::filesystem::file_size(log_);
  log->send(SIGCONT);
  ASSERT_TRUE(eventually([&] { return std::filesystem::file_size(log_) > size_then + 100'000; }, seconds(20)));
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(10)), 128 + SIGKILL);
  copy(folder_ / "kept", folder_ / "state");
  log = logger();
  ASSERT_TRUE(reaches(sim_time_s() + 5.0)) << log->output();
  Process stop("inslab", {"stop", "--domain", own_domain()});
  EXPECT_EQ(stop.wait(seconds(30)), 0) << stop.output();
  for (const auto* each : {&imu, &gnss, &truth}) EXPECT_EQ((*each)->wait(seconds(60)), 0) << (*each)->output();
  EXPECT_EQ(log->wait(seconds(20)), 0) << log->output();
  for (const std::string topic : {"inslab/truth", "inslab/imu/0", "inslab/imu_truth/0", "inslab/gnss/0"}) {
    std::map<std::uint64_t, int> times;
    const mcap::McapReader reader(log_);
    reader.for_each([&](const mcap::Message& message) {
      if (reader.channels().at(message.channel_id).topic == topic) ++times[message.sequence];
      return true;
    });
    ASSERT_GT(times.size(), 10u) << topic;
    EXPECT_EQ(times.rbegin()->first + 1, times.size()) << topic;
    for (const auto& [number, count] : times) ASSERT_EQ(count, 1) << topic << " sample " << number;
  }
}

TEST_F(KilledLogger, HasEverySolutionThatCameMeanwhileOnceAndSaysSo) {
  Process run("inslab", {"run", scenario("reference_nav"), "--log", log_, "--domain", own_domain()});
  ASSERT_TRUE(reaches(4.0)) << run.output();
  kill_child(run, "inslab-truth-logger");
  EXPECT_TRUE(run.wait(seconds(90))) << run.output();
  EXPECT_THAT(run.output(), HasSubstr("recovered: inslab/nav: 0 messages that were sent while the logger was away are "
                                      "missing"));
  EXPECT_EQ(solutions().size(), 2000u);
  EXPECT_EQ(answered().size(), 2000u);
  EXPECT_EQ(missing("inslab/nav"), "0");
}

TEST_F(KilledLogger, HasTheSolutionsThatCameMeanwhileInLockstepToo) {
  Process run("inslab",
              {"run", scenario("reference_nav_long"), "--domain", own_domain(), "--log", log_, "--clock", "lockstep"});
  ASSERT_TRUE(reaches(30.0)) << run.output();
  kill_child(run, "inslab-truth-logger");
  EXPECT_TRUE(run.wait(seconds(120))) << run.output();
  EXPECT_EQ(solutions().size(), 60'000u);
  EXPECT_EQ(answered().size(), 60'000u);
  EXPECT_EQ(missing("inslab/block/nav"), "0");
}

/// The app is one that keeps nothing: its writer is volatile.
TEST_F(KilledLogger, SaysHowManySolutionsItLacksOfAnAppThatKeepsNone) {
  const auto logger = [this] { return service("inslab-truth-logger", "recovery_long", {"--log", log_}); };
  auto log = logger();
  const auto imu = service("inslab-imu-injector", "recovery_long");
  const auto gnss = service("inslab-gnss-emulator", "recovery_long");
  const auto truth = service("inslab-trajectory-server", "recovery_long", {"--clock", "real_time", "--rate", "1"});
  dds::Writer<NavSolution> app(participant_, dds::topics::nav());
  NavSolution solution;
  const auto answer = [&] {
    EXPECT_TRUE(app.write(solution));
    ++solution.imu_sequence;
  };
  ASSERT_TRUE(reaches(1.0)) << truth->output();
  ASSERT_TRUE(eventually([&] { return app.matched_readers() > 0; }, seconds(20)));
  for (int i = 0; i < 10; ++i) answer();
  ASSERT_TRUE(app.wait_for_acknowledgments(seconds(10)));
  log->send(SIGKILL);
  ASSERT_EQ(log->wait(seconds(10)), 128 + SIGKILL);
  for (int i = 0; i < 7; ++i) answer();
  log = logger();
  EXPECT_TRUE(eventually(
      [&] {
        answer();
        return log->output().find("inslab/nav: ") != std::string::npos;
      },
      seconds(60)))
      << log->output();
  truth->send(SIGTERM);
  EXPECT_TRUE(log->wait(seconds(60))) << log->output();
  const std::set<std::uint64_t> logged = answered();
  const std::uint64_t lacks = *logged.rbegin() + 1 - logged.size();
  EXPECT_GE(lacks, 7u);
  EXPECT_EQ(missing("inslab/nav"), std::to_string(lacks));
  EXPECT_THAT(log->output(), HasSubstr("inslab/nav: " + std::to_string(lacks) +
                                       " messages that were sent while this service was away are missing"));
}

}  // namespace killed_logger_test
}  // namespace inslab::e2e
