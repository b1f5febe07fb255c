#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace foreign_apps_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

/// Sets a variable for the processes started while it lives.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
};

using Values = std::map<std::uint64_t, std::pair<double, double>>;

/// What an app wrote with --values, by stream and sequence number.
std::map<std::string, Values> values_of(const std::string& path) {
  std::map<std::string, Values> values;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string stream, first, second;
    std::uint64_t sequence = 0;
    words >> stream >> sequence >> first >> second;
    values[stream][sequence] = {std::strtod(first.c_str(), nullptr), std::strtod(second.c_str(), nullptr)};
  }
  return values;
}

/// The same of a log.
template <class T, class Pick>
Values logged(const std::string& log, const std::string& topic, const Pick& pick) {
  Values values;
  for (const T& sample : samples_of<T>(log, topic)) values[sample.header.sequence_number] = pick(sample);
  return values;
}

struct App {
  const char* program;
  const char* variable;
  const char* settings;

  friend void PrintTo(const App& app, std::ostream* out) { *out << app.program; }
};

class ForeignApp : public testing::TestWithParam<App> {
 protected:
  std::unique_ptr<Process> app(std::vector<std::string> more = {}) const {
    const Environment environment(GetParam().variable, GetParam().settings);
    std::vector<std::string> all{"--domain", own_domain(), "--seconds", "90", "--values", values_};
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<Process>(GetParam().program, all);
  }
  std::unique_ptr<Process> set(std::vector<std::string> more = {}) const {
    std::vector<std::string> all{"run", source("tests/data/foreign.json"), "--domain", own_domain(), "--log", log_};
    all.insert(all.end(), more.begin(), more.end());
    return std::make_unique<Process>("inslab", all);
  }
  void expect_everything_arrived(Process& navigation, Process& run) const {
    EXPECT_EQ(run.wait(seconds(90)), 0) << run.output();
    EXPECT_EQ(navigation.wait(seconds(20)), 0) << navigation.output();
    EXPECT_THAT(navigation.output(), HasSubstr("inslab/truth: 1201 samples, 0 missing"));
    EXPECT_THAT(navigation.output(), HasSubstr("inslab/imu/0: 1200 samples, 0 missing"));
    EXPECT_THAT(navigation.output(), HasSubstr("inslab/gnss/0: 60 samples, 0 missing"));
    EXPECT_THAT(navigation.output(), HasSubstr("inslab/nav: 1200 solutions published"));
    auto received = values_of(values_);
    EXPECT_EQ(received["imu"], logged<ImuSample>(log_, "inslab/imu/0", [](const ImuSample& s) {
                return std::make_pair(s.dtheta_b.x(), s.dv_b.z());
              }));
    EXPECT_EQ(received["gnss"], logged<GnssFix>(log_, "inslab/gnss/0", [](const GnssFix& s) {
                return std::make_pair(s.latitude_rad, s.height_m);
              }));
    EXPECT_EQ(received["truth"], logged<TruthState>(log_, "inslab/truth", [](const TruthState& s) {
                return std::make_pair(s.latitude_rad, s.dv_v.z());
              }));
    EXPECT_EQ(solutions_logged(), 1200U);
  }
  std::size_t solutions_logged() const {
    const mcap::McapReader log(log_);
    std::size_t count = 0;
    log.for_each([&](const mcap::Message& message) {
      count += log.channels().at(message.channel_id).topic == "inslab/nav" ? 1 : 0;
      return true;
    });
    return count;
  }

  TestFolder folder_;
  std::string log_ = folder_ / "log.mcap";
  std::string values_ = folder_ / "values.txt";
};

TEST_P(ForeignApp, WithOurIdlAloneReceivesEverySampleAndIsLogged) {
  const auto run = set();
  const auto navigation = app();
  expect_everything_arrived(*navigation, *run);
}

TEST_P(ForeignApp, SetsThePaceOfLockstepByItsImuSequence) {
  const auto run = set({"--clock", "lockstep"});
  const auto navigation = app();
  expect_everything_arrived(*navigation, *run);
}

INSTANTIATE_TEST_SUITE_P(Vendors, ForeignApp,
                         testing::Values(App{"fastdds_nav_client", "FASTRTPS_DEFAULT_PROFILES_FILE",
                                             INSLAB_SOURCE_DIR "/config/dds/loopback.xml"},
                                         App{"cyclone_nav_client", "CYCLONEDDS_URI",
                                             "file://" INSLAB_SOURCE_DIR "/deploy/clients/cyclone/cyclonedds.xml"}),
                         [](const auto& instance) { return std::string(instance.param.program); });

/// The solutions of one unit come from one app.
class NavigationApps : public testing::Test {
 protected:
  static std::unique_ptr<Process> app() {
    const Environment environment("FASTRTPS_DEFAULT_PROFILES_FILE", source("config/dds/loopback.xml"));
    return std::make_unique<Process>("fastdds_nav_client", std::vector<std::string>{"--domain", own_domain()});
  }
  std::unique_ptr<Process> set(const std::string& scenario) const {
    return std::make_unique<Process>(
        "inslab", std::vector<std::string>{"run", source("tests/data/" + scenario), "--domain", own_domain(), "--log",
                                           folder_ / "log.mcap"});
  }
  static std::string last_line(const Process& process) {
    const std::string text = process.output();
    return text.substr(text.find_last_of('\n', text.size() - 2) + 1);
  }

  const TestFolder folder_;
};

TEST_F(NavigationApps, OfWhichTwoWriteAreAFaultThatNamesBoth) {
  const auto first = app();
  const auto run = set("foreign.json");
  ASSERT_TRUE(run->prints("foreign: 1", seconds(60))) << run->output();
  const auto second = app();
  EXPECT_TRUE(run->prints("inslab/nav: a second writer beside ", seconds(20))) << run->output();
  EXPECT_EQ(run->wait(seconds(60)), 1) << run->output();
  EXPECT_THAT(last_line(*run), HasSubstr("inslab/nav: a second writer beside ")) << run->output();
}

TEST_F(NavigationApps, OfWhichOneFollowsTheOtherAreNone) {
  const auto killed = app();
  const auto run = set("foreign.json");
  ASSERT_TRUE(run->prints("foreign: 1", seconds(60))) << run->output();
  killed->send(SIGKILL);
  const auto follows = app();
  EXPECT_EQ(run->wait(seconds(60)), 0) << run->output();
  EXPECT_THAT(run->output(), Not(HasSubstr("second writer")));
}

TEST_F(NavigationApps, BesideTheReferenceAppAreAFaultAtTheirFirstSolution) {
  const auto run = set("reference_nav.json");
  const auto foreign = app();
  EXPECT_TRUE(run->prints("inslab/nav: a writer that is not this set's: ", seconds(60))) << run->output();
  run->send(SIGTERM);
  EXPECT_EQ(run->wait(seconds(60)), 1) << run->output();
}

TEST(ForeignAppOnBlocks, TakesPartInLockstepWithTheBlocksAlone) {
  const TestFolder folder;
  const Environment environment("FASTRTPS_DEFAULT_PROFILES_FILE", source("config/dds/loopback.xml"));
  // First: the run does not wait for it.
  Process app("fastdds_nav_client", {"--domain", own_domain(), "--seconds", "90", "--blocks", "1"});
  ASSERT_TRUE(app.prints("waits for a run", seconds(30))) << app.output();
  Process run("inslab", {"run", source("tests/data/foreign_blocks.json"), "--domain", own_domain(), "--log",
                         folder / "log.mcap", "--clock", "lockstep"});
  EXPECT_EQ(run.wait(seconds(90)), 0) << run.output();
  EXPECT_EQ(app.wait(seconds(20)), 0) << app.output();
  EXPECT_THAT(app.output(), HasSubstr("inslab/block/imu/0: 1200 samples, 0 missing"));
  EXPECT_THAT(app.output(), HasSubstr("inslab/block/gnss/0: 60 samples, 0 missing"));
}

TEST(ForeignClient, OfAnotherVendorSwapsAProfileAndIsToldWhatBecameOfIt) {
  const TestFolder folder;
  Process run("inslab",
              {"run", source("tests/data/storm.json"), "--domain", own_domain(), "--log", folder / "log.mcap"});
  const Environment environment("CYCLONEDDS_URI", "file://" + source("deploy/clients/cyclone/cyclonedds.xml"));
  ASSERT_TRUE(run.prints(" of 3600.0 s", seconds(60))) << run.output();
  const auto swap = [](std::vector<std::string> words) {
    words.insert(words.end(), {"--domain", own_domain()});
    return std::make_unique<Process>("cyclone_swap_client", words);
  };
  const auto good = swap({"0.5", "-0.25", "-1.5"});
  const auto stranger = swap({"0.5", "0", "0", "--receiver", "4"});
  EXPECT_EQ(good->wait(seconds(40)), 0) << good->output();
  EXPECT_THAT(good->output(), testing::ContainsRegex("in effect from [0-9.]+ s on, first sample [0-9]+"));
  EXPECT_EQ(stranger->wait(seconds(40)), 3);
  EXPECT_THAT(stranger->output(), HasSubstr("not in effect: target_number: names gnss4"));
  run.send(SIGTERM);
  EXPECT_EQ(run.wait(seconds(60)), 1) << run.output();  // it was not to its end
  const auto journal = samples_of_kind<InstallationProfile>(folder / "log.mcap", "inslab/journal/installation");
  const auto entry = std::find_if(journal.begin(), journal.end(),
                                  [](const auto& profile) { return profile.name == "from another vendor"; });
  ASSERT_NE(entry, journal.end());
  EXPECT_EQ(entry->lever_arm_v_m, Vector3(0.5, -0.25, -1.5));
}

TEST(RequiredSubscribers, BarrierNamesWhatItWaitsFor) {
  const TestFolder folder;
  Process run("inslab", {"run", source("tests/data/foreign.json"), "--domain", own_domain(), "--unit", "truck", "--log",
                         folder / "log.mcap"});
  EXPECT_TRUE(run.prints("waits for an app: ", seconds(20))) << run.output();
  EXPECT_EQ(run.wait(seconds(60)), 1);
  EXPECT_THAT(run.output(), HasSubstr("a writer of inslab/nav"));
  EXPECT_THAT(run.output(), HasSubstr("a reader of inslab/gnss/0"));
  EXPECT_THAT(run.output(), HasSubstr("on domain " + own_domain() + ", unit 'truck', interface 127.0.0.1"));
  EXPECT_THAT(run.output(), Not(HasSubstr("not ready: inslab")));
}

TEST(StoppedSubscriber, CostsTheOtherReadersNothing) {
  const TestFolder folder;
  const Environment environment("FASTRTPS_DEFAULT_PROFILES_FILE", source("config/dds/loopback.xml"));
  Process stuck("fastdds_nav_client", {"--domain", own_domain(), "--seconds", "120"});
  unsetenv("FASTRTPS_DEFAULT_PROFILES_FILE");
  // The run takes part of it for granted: exit 0 means that nothing was lost on any stream.
  Process run("inslab",
              {"run", source("tests/data/short.json"), "--domain", own_domain(), "--log", folder / "log.mcap"});
  ASSERT_TRUE(run.prints("short: 2", seconds(40))) << run.output();
  stuck.send(SIGSTOP);
  EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
  EXPECT_EQ(samples_of<ImuSample>(folder / "log.mcap", "inslab/imu/0").size(), 1600U);
  stuck.send(SIGKILL);
}

}  // namespace foreign_apps_test
}  // namespace inslab::e2e
