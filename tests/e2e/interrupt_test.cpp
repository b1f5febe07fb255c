// What every command does when it is told to end: it is gone within 2 s with 128 + the signal's number, its last line
// says so, and of its results there is nothing or all.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace interrupt_test {

using std::chrono::seconds;
using testing::HasSubstr;

std::vector<std::string> names_in(const std::string& folder) {
  std::vector<std::string> names;
  if (!std::filesystem::exists(folder)) return names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

/// A scenario that takes far longer than the test.
std::string endless_scenario(const TestFolder& folder) {
  const std::string path = folder / "endless.json";
  std::ofstream(path) << R"({"name": "endless", "seed": 1,
    "start": {"at": "gps_time", "gps_week": 2446, "gps_seconds_of_week_s": 36000},
    "duration_s": 1000000, "truth_rate_hz": 200,
    "trajectory": {"initial": {"latitude_deg": 48, "longitude_deg": 11, "height_m": 500, "yaw_deg": 0},
    "segments": [{"duration_s": 1000000}]}, "imu": [{"number": 0, "rate_hz": 200}]})";
  return path;
}

/// Whether a process has become `program` and has its own handler of the signal.
bool handles(pid_t process, const std::string& program, int signal) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  bool is_program = false;
  for (std::string line; std::getline(status, line);) {
    if (line == "Name:\t" + program) is_program = true;
    if (line.rfind("SigCgt:", 0) == 0)
      return is_program && (std::stoull(line.substr(8), nullptr, 16) >> (signal - 1) & 1) != 0;
  }
  return false;
}

/// Sends the signal once `begun` holds, and expects the ending that the command is to have.
void expect_ending(const std::string& words, Process& process, int signal, const std::function<bool()>& begun) {
  ASSERT_TRUE(eventually(begun, seconds(60))) << words << ": " << process.output();
  process.send(signal);
  const auto code = process.wait(seconds(2));
  ASSERT_TRUE(code) << words << " does not end";
  EXPECT_EQ(*code, 128 + signal) << words << ": " << process.output();
  const std::string name = signal == SIGINT ? "SIGINT" : "SIGTERM";
  EXPECT_THAT(process.output(), HasSubstr("inslab " + words + ": ended by " + name + ", exit code " +
                                          std::to_string(128 + signal) + "; what was not whole is removed\n"));
}

TEST(Interrupt, SimulateLeavesNoHalfLog) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const TestFolder folder;
    Process process("inslab", {"simulate", endless_scenario(folder), "-o", folder / "out"});
    expect_ending("simulate", process, signal, [&] { return !names_in(folder / "out").empty(); });
    EXPECT_TRUE(names_in(folder / "out").empty());
  }
}

TEST(Interrupt, VerifyIsNotDeafInItsComputations) {
  Process process("inslab", {"verify", "allan", "--full"});
  expect_ending("verify allan", process, SIGTERM, [&] { return handles(process.pid(), "inslab-study", SIGTERM); });
}

TEST(Interrupt, MontecarloEndsItsRunsToo) {
  const TestFolder folder;
  Process process("inslab", {"montecarlo", source("tests/data/reference_nav_long.json"), "-n", "50", "-j", "2", "-o",
                             folder / "study"});
  std::vector<pid_t> runs;
  ASSERT_TRUE(eventually(
      [&] {
        runs = children_named(process.pid(), "inslab-study");
        return runs.size() == 2;
      },
      seconds(60)));
  expect_ending("montecarlo", process, SIGTERM, [&] { return handles(process.pid(), "inslab-study", SIGTERM); });
  for (const pid_t run : runs) EXPECT_EQ(kill(run, 0), -1);
  for (const std::string& name : names_in(folder / "study")) EXPECT_NE(name.front(), '.') << name;
}

/// What reads a log and writes beside it.
TEST(Interrupt, CommandsOnALogLeaveNothingHalf) {
  const TestFolder folder;
  const std::string log = folder / "endless.mcap";
  {
    const std::string scenario = endless_scenario(folder);
    std::ifstream in(scenario);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    for (std::size_t at = 0; (at = text.find("1000000", at)) != std::string::npos;) text.replace(at, 7, "1800");
    std::ofstream(folder / "half_hour.json") << text;
    Process simulate("inslab", {"simulate", folder / "half_hour.json", "-o", folder / "logs"});
    ASSERT_EQ(simulate.wait(seconds(60)), 0) << simulate.output();
    std::filesystem::rename(folder / "logs/endless.mcap", log);
  }
  for (const std::string& format : {std::string("csv"), std::string("hdf5"), std::string("imu")}) {
    const std::string out = folder / ("out_" + format);
    std::filesystem::create_directory(out);
    Process process("inslab", {"export", log, "--format", format, "-o", out + "/result"});
    expect_ending("export", process, SIGTERM, [&] { return !names_in(out).empty(); });
    EXPECT_TRUE(names_in(out).empty()) << format;
  }
}

}  // namespace interrupt_test
}  // namespace inslab::e2e
