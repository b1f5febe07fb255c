// inslab montecarlo as a command: what survives a SIGKILL, what is refused, and the same through a job array.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace montecarlo_test {

using std::chrono::seconds;
using testing::HasSubstr;

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

constexpr const char* kAtRest = "tests/data/reference_nav_at_rest.json";

std::vector<std::string> study_in(const std::string& folder, const std::vector<std::string>& more = {},
                                  const char* scenario = "tests/data/reference_nav.json") {
  std::vector<std::string> words{"montecarlo", source(scenario), "-n", "4", "-o", folder};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The exit code, and what was printed.
std::pair<int, std::string> inslab(const std::vector<std::string>& words) {
  Process process("inslab", words);
  const int code = process.wait(seconds(120)).value_or(-1);
  return {code, process.output()};
}

TEST(Montecarlo, AStudyThatWasKilledGoesOnToTheSameSummary) {
  const TestFolder folder;
  const std::string whole = folder / "whole", killed = folder / "killed";
  const auto [code, text] = inslab(study_in(whole, {"-j", "2"}));
  ASSERT_EQ(code, 0) << text;
  EXPECT_THAT(text, HasSubstr("reference_nav: 4 of 4 runs, seeds 5 to 8\n"));
  EXPECT_THAT(text, HasSubstr("4 of 4, share 1 "));

  Process first("inslab", study_in(killed, {"-j", "2"}));
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(killed + "/run_000000.json"); }, seconds(60)))
      << first.output();
  first.send(SIGKILL);
  ASSERT_TRUE(first.wait(seconds(30)));
  const auto done = std::filesystem::last_write_time(killed + "/run_000000.json");
  const auto [resumed, said] = inslab(study_in(killed, {"-j", "2"}));
  EXPECT_EQ(resumed, 0) << said;
  EXPECT_EQ(std::filesystem::last_write_time(killed + "/run_000000.json"), done);  // it was not done again
  for (const char* name : {"/summary.txt", "/summary.json", "/summary.svg"}) {
    EXPECT_FALSE(text_of(whole + name).empty()) << name;
    EXPECT_EQ(text_of(killed + name), text_of(whole + name)) << name;
  }
}

TEST(Montecarlo, PartsAreSummarisedOnceAllAreThere) {
  const TestFolder folder;
  const std::string parts = folder / "parts";
  const auto [code, text] = inslab(study_in(parts, {"--part", "2/2"}));
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text, HasSubstr("2 of 4 runs are in " + parts + "; the summary waits for the rest"));
  const auto [early, missing] = inslab(study_in(parts, {"--summary-only"}));
  EXPECT_EQ(early, 1);
  EXPECT_THAT(missing, HasSubstr("MISSING 2 runs, the first is run 0"));
  const auto [rest, summary] = inslab(study_in(parts, {"--part", "1/2"}));
  EXPECT_EQ(rest, 0) << summary;
  EXPECT_THAT(summary, HasSubstr("reference_nav: 4 of 4 runs"));
}

TEST(Montecarlo, ARunThatFailsIsNamedWithItsReason) {
  const TestFolder folder;
  // A minute of alignment in ten seconds; without motion there is no other beginning.
  std::ofstream(folder / "patient.json") << R"({"name": "patient", "initial": {"attitude": "static_alignment"}})";
  const auto [code, text] =
      inslab(study_in(folder / "failed", {"--parameters", folder / "patient.json", "--draw-start"}, kAtRest));
  EXPECT_EQ(code, 0) << text;  // it begins at the truth
  const auto [failed, said] = inslab(study_in(folder / "failing", {"--parameters", folder / "patient.json"}, kAtRest));
  EXPECT_EQ(failed, 1);
  EXPECT_THAT(said, HasSubstr("FAILED  run 3, seed 8: no solution was scored: "));
}

TEST(Montecarlo, ARunWhoseProcessIsKilledIsNamedAndDoneAgain) {
  const TestFolder folder;
  // Twenty minutes of a car, so that there is time to kill its process.
  const std::vector<std::string> words{
      "montecarlo", source("config/scenarios/vehicle.json"), "-n", "1", "--draw-start", "-o", folder / "study"};
  Process study("inslab", words);
  std::vector<pid_t> runs;
  ASSERT_TRUE(eventually([&] { return !(runs = children_named(study.pid(), "inslab-study")).empty(); }, seconds(60)));
  kill(runs.front(), SIGKILL);
  EXPECT_EQ(study.wait(seconds(60)), 1);
  EXPECT_THAT(study.output(), HasSubstr("vehicle: 0 of 1 runs, seeds 20261123 to 20261123\n"
                                        "FAILED  run 0, seed 20261123: inslab-study was ended by signal 9 (Killed)\n"));
  const auto [code, text] = inslab(words);
  EXPECT_EQ(code, 0) << text;
  EXPECT_THAT(text, HasSubstr("vehicle: 1 of 1 runs"));
}

TEST(Montecarlo, BadInputIsRefused) {
  const TestFolder folder;
  EXPECT_EQ(inslab(study_in(folder / "refused", {"--one", "4"})).first, 2);
  for (const char* part : {"3/2", "0/2", "2", "-1/2", "a/b", "1/2x", "1/2/2"}) {
    const auto [code, text] = inslab(study_in(folder / "refused", {std::string("--part=") + part}));
    EXPECT_EQ(code, 2) << part;
    EXPECT_THAT(text, HasSubstr("expected K/T with 1 <= K <= T")) << part;
  }
  const auto [missing, what] = inslab(study_in(folder / "refused", {"--parameters", folder / "nothing.json"}));
  EXPECT_EQ(missing, 2);
  EXPECT_THAT(what, HasSubstr("nothing.json"));
}

TEST(Montecarlo, AFolderOfAnotherStudyIsRefused) {
  const TestFolder folder;
  const std::string taken = folder / "taken";
  ASSERT_EQ(inslab(study_in(taken, {"--part", "1/4"})).first, 0);
  const auto [code, text] = inslab(study_in(taken, {"--parameters", source("config/nav/car_mems.json")}));
  EXPECT_EQ(code, 2);
  EXPECT_THAT(text, HasSubstr(taken + ": holds the results of another study: filter"));
}

/// A Slurm of one node, ended with the test.
class OneNode {
 public:
  explicit OneNode(const std::string& folder) : folder_(folder) {
    Process start(source("deploy/slurm/one-node"), {"start", folder});
    started_ = start.wait(seconds(60)) == 0;
    said_ = start.output();
  }
  ~OneNode() {
    Process stop(source("deploy/slurm/one-node"), {"stop", folder_});
    stop.wait(seconds(60));
  }
  OneNode(const OneNode&) = delete;
  OneNode& operator=(const OneNode&) = delete;

  bool started() const { return started_; }
  const std::string& said() const { return said_; }

 private:
  std::string folder_;
  std::string said_;
  bool started_ = false;
};

TEST(Montecarlo, AJobArrayOfSlurmGivesTheSameSummary) {
  if (!std::filesystem::exists("/sys/devices/system/cpu/cpu0/topology")) {
    GTEST_SKIP() << "Slurm's node reads what processors there are from /sys, which is not mounted here";
  }
  for (const char* program : {"slurmctld", "slurmd", "munged"}) {
    if (Process("which", {program}).wait(seconds(10)) != 0) GTEST_SKIP() << program << " is not installed";
  }
  const TestFolder folder;
  const std::string whole = folder / "whole", array = folder / "array";
  ASSERT_EQ(inslab(study_in(whole)).first, 0);
  const OneNode node(folder / "slurm");
  ASSERT_TRUE(node.started()) << node.said();
  setenv("SLURM_CONF", (folder / "slurm/slurm.conf").c_str(), 1);
  Process submit(source("deploy/slurm/submit"), {"--tasks", "2", "--program", INSLAB_BINARY_DIR "/bin/inslab", "-o",
                                                 array, source("tests/data/reference_nav.json"), "-n", "4"});
  const auto code = submit.wait(seconds(60));
  unsetenv("SLURM_CONF");
  ASSERT_EQ(code, 0) << submit.output();
  const std::string log = array + "/slurm/summary.log";
  EXPECT_TRUE(eventually([&] { return text_of(log).find(" written") != std::string::npos; }, seconds(120)))
      << submit.output() << text_of(log);
  EXPECT_EQ(text_of(array + "/summary.json"), text_of(whole + "/summary.json"));
  EXPECT_THAT(text_of(array + "/slurm/task_2.log"), HasSubstr(" of 2 runs done"));
}

}  // namespace montecarlo_test
}  // namespace inslab::e2e
