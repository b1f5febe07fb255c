// deploy/lab with all of the set on this host: what it refuses, what it leaves alone, what it says of a run.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace one_host_test {

using std::chrono::seconds;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

void write(const std::string& path, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path) << text;
}

std::string read(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

class LabOnOneHost : public testing::Test {
 protected:
  /// The host's folder has this build's programs unless `empty`.
  std::string inventory(const std::string& scenario, const std::string& more = "", bool empty = false) {
    return inventory_of(R"("imu-injector:0", "gnss-emulator:0")", scenario, more, empty);
  }
  std::string inventory_of(const std::string& sensors, const std::string& scenario, const std::string& more = "",
                           bool empty = false) {
    std::filesystem::create_directories(host());
    if (!empty && !std::filesystem::exists(host() + "/build")) {
      for (const char* shared : {"build", "config", "tests"}) {
        std::filesystem::create_symlink(source(shared), host() + "/" + shared);
      }
    }
    const std::string path = folder_ / ("inventory" + std::to_string(++inventories_) + ".json");
    write(path, R"({"scenario": ")" + scenario + R"(", "domain": )" + own_domain() + more +
                    R"(, "hosts": [{"name": "here", "address": "127.0.0.1", "folder": ")" + host() +
                    R"(", "services": ["trajectory-server", )" + sensors + R"(, "truth-logger"]}]})");
    return path;
  }

  std::string host() const { return folder_ / "host"; }

  std::unique_ptr<Process> lab(const std::string& action, const std::string& inventory) const {
    return std::make_unique<Process>(source("deploy/lab"), std::vector<std::string>{action, inventory});
  }

  /// What it says; its exit code must be `code`.
  std::string says(int code, const std::string& action, const std::string& inventory) const {
    const auto process = lab(action, inventory);
    EXPECT_EQ(process->wait(seconds(90)), code) << process->output();
    return process->output();
  }

  TestFolder folder_;
  int inventories_ = 0;
};

TEST_F(LabOnOneHost, ASecondSetOfTheSameUnitIsRefusedAndTheFirstGoesOn) {
  const std::string paused = R"(, "clock": ["--paused"])";  // it is there for as long as the others need to be refused
  const std::string first = inventory("tests/data/lab.json", paused);
  const auto run = lab("run", first);
  ASSERT_TRUE(run->prints(" of 4.0 s", seconds(60))) << run->output();
  const std::string refusal = says(1, "run", inventory("tests/data/lab.json"));
  EXPECT_THAT(refusal, HasSubstr("here: truth-logger runs already: process "));
  EXPECT_THAT(refusal, HasSubstr("from " + std::filesystem::canonical(first).string()));
  const std::string same_log = inventory("tests/data/lab.json", R"(, "unit": "other")");
  EXPECT_THAT(says(1, "run", same_log), HasSubstr("runs/lab.mcap is written by another set: process "));
  Process resume("inslab", {"resume", "--domain", own_domain()});
  EXPECT_EQ(resume.wait(seconds(30)), 0) << resume.output();
  EXPECT_EQ(run->wait(seconds(60)), 0) << run->output();
  EXPECT_EQ(samples_of<ImuSample>(host() + "/runs/lab.mcap", "inslab/imu/0").size(), 400u);
}

TEST_F(LabOnOneHost, ASetThatDoesNotStartIsAnErrorAndNoLogOfBefore) {
  write(host() + "/runs/lab.mcap", "of an earlier run");
  const std::string set = inventory("tests/data/lab.json");
  const std::string programs = host() + "/build/bin", server = programs + "/inslab-trajectory-server";
  std::filesystem::remove(host() + "/build");
  std::filesystem::create_directories(programs);
  for (const auto& entry : std::filesystem::directory_iterator(program(""))) {
    std::filesystem::create_symlink(entry.path(), programs + "/" + entry.path().filename().string());
  }
  std::filesystem::remove(server);
  write(server, "#!/bin/sh\necho no library of that name\nexit 127\n");
  std::filesystem::permissions(server, std::filesystem::perms::owner_all);
  const std::string said = says(1, "run", set);
  EXPECT_THAT(said, HasSubstr("---- here: trajectory-server\nno library of that name\n"));
  EXPECT_THAT(said, HasSubstr("lab: here: trajectory-server ended with exit code 127 before the run began"));
  EXPECT_THAT(said, Not(HasSubstr("checks held")));
  EXPECT_THAT(says(0, "status", inventory("tests/data/lab.json")), Not(HasSubstr("  running")));
}

TEST_F(LabOnOneHost, WhatNoSetCouldBeStartedWithIsRefusedBeforeAnythingStarts) {
  const std::string scenario = "tests/data/lab.json";
  EXPECT_THAT(says(2, "check", inventory(scenario, R"(, "clock": ["--rate", "much"])")),
              ContainsRegex("clock: .*--rate.*much"));
  EXPECT_THAT(says(2, "run", inventory(scenario, R"(, "clock": ["--faster"])")), ContainsRegex("clock: .*--faster"));
  EXPECT_THAT(
      says(2, "check", inventory_of(R"("imu-injector:0", "imu-injector:1", "gnss-emulator:0")", scenario)),
      HasSubstr("hosts[0].services[2]: is 'imu-injector:1'; tests/data/lab.json has no imu 1, its numbers are 0"));
  EXPECT_THAT(says(2, "check", inventory_of(R"("imu-injector", "gnss-emulator", "magnetometer")", scenario)),
              HasSubstr("hosts[0].services[3]: is 'magnetometer:0'; tests/data/lab.json has no magnetometer"));
  EXPECT_THAT(
      says(2, "check", inventory_of(R"("imu-injector:0")", scenario)),
      HasSubstr("hosts: none runs gnss-emulator:0, for which the set would wait: tests/data/lab.json has gnss 0"));
  EXPECT_THAT(says(0, "check", inventory(scenario, R"(, "clock": ["--clock", "lockstep"])")),
              HasSubstr("good: 1 hosts"));
}

TEST_F(LabOnOneHost, AScenarioFromElsewhereIsBroughtWithAllThatItNamesAndItsAcceptanceIsTheExitCode) {
  std::filesystem::create_directories(folder_ / "mine/profiles");
  const std::string receiver = std::filesystem::canonical(folder_ / "mine").string() + "/absolute.json";
  std::filesystem::copy(source("config/profiles/imu/stim300.json"), folder_ / "mine/profiles/imu.json");
  std::filesystem::copy(source("config/profiles/gnss/rtk.json"), receiver);
  write(folder_ / "mine/scenarios/drive.json", R"({
    "name": "elsewhere", "seed": 6, "start": {"at": "gps_time", "gps_week": 2446, "gps_seconds_of_week_s": 36000},
    "duration_s": 1, "truth_rate_hz": 100,
    "trajectory": {"initial": {"latitude_deg": 48, "longitude_deg": 11, "height_m": 520},
                   "segments": [{"duration_s": 1, "motions": [{"type": "turn", "angle_deg": 40}]}]},
    "imu": [{"number": 0, "rate_hz": 100, "error_profile": "../profiles/imu.json"}],
    "gnss": [{"number": 0, "rate_hz": 10, "error_profile": ")" +
                                                   receiver + R"("}],
    "acceptance": [{"metric": "stale", "at_most": 0}],
    "clock": {"max_lag_ms": 2000}})");
  const std::string file = inventory(folder_ / "mine/scenarios/drive.json", "", true);
  const std::string lacking = says(1, "run", file);
  EXPECT_THAT(lacking, HasSubstr("here: build/bin/inslab-truth-logger is not there"));
  EXPECT_THAT(lacking, HasSubstr("/mine/profiles/imu.json is not there"));
  says(0, "install", file);
  const std::string said = says(4, "run", file);
  EXPECT_THAT(said, HasSubstr("elsewhere: 1.0 of 1.0 s"));
  EXPECT_THAT(said, ContainsRegex("FAIL.*: 0 of 1 acceptance lines passed[^\n]*\n$"));
  write(folder_ / "mine/profiles/imu.json", read(folder_ / "mine/profiles/imu.json") + "\n");
  EXPECT_THAT(says(1, "run", file), HasSubstr("/mine/profiles/imu.json is another than here"));
}

TEST_F(LabOnOneHost, StopEndsNoStrangerWhoHasTheNumberOfAProcessThatIsGone) {
  const Process stranger("sleep", {"100"});
  const std::string pid = std::to_string(stranger.pid());
  const std::string boot = read("/proc/sys/kernel/random/boot_id");
  const std::string file = inventory("tests/data/lab.json");
  const std::string place = host() + "/run/truth-logger-" + own_domain() + "-0.pid";
  for (const std::string& stale : {pid + "\n", pid + " 1 " + boot}) {
    write(place, stale);
    says(0, "stop", file);
    EXPECT_THAT(says(0, "status", file), Not(HasSubstr("  running")));
    EXPECT_EQ(kill(stranger.pid(), 0), 0);
    EXPECT_THAT(read("/proc/" + pid + "/stat"), HasSubstr(") S ")) << "it has been ended";
  }
}

TEST_F(LabOnOneHost, StartedItGoesOnWithoutTheLabUntilItIsStopped) {
  const std::string file = inventory("tests/data/lab_link_down.json");
  EXPECT_THAT(says(0, "start", file), HasSubstr(" goes on\n"));
  EXPECT_THAT(says(0, "status", file), HasSubstr("  running"));
  says(0, "stop", file);
  EXPECT_THAT(says(0, "status", file), Not(HasSubstr("  running")));
}

}  // namespace one_host_test
}  // namespace inslab::e2e
