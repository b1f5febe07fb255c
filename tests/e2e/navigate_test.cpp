// The command `inslab navigate`, as a user calls it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace navigate_test {

using std::chrono::seconds;
using testing::HasSubstr;

constexpr int kBadInput = 2;

using Rows = std::vector<std::vector<double>>;

Rows numbers_of(const std::string& path) {
  Rows rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (double number = 0.0; fields >> number;) rows.back().push_back(number);
  }
  return rows;
}

/// Ten seconds of tests/data/reference_nav.json, with the solutions of its app, and the log's text files.
class Navigate : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TestFolder;
    run({"simulate", kScenario, "-o", *folder_ / "."});
    run({"export", log(), "--format", "imu", "-o", *folder_ / "imu.txt"});
    run({"export", log(), "--format", "gnss", "-o", *folder_ / "gnss.txt"});
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }

  static std::string run(const std::vector<std::string>& arguments, int expected = 0) {
    Process command("inslab", arguments);
    EXPECT_EQ(command.wait(seconds(60)), expected) << command.output();
    return command.output();
  }
  static std::string log() { return *folder_ / "reference_nav.mcap"; }

  /// `navigate` with these arguments is refused with this message, and writes nothing.
  static void expect_refusal(std::vector<std::string> arguments, const std::string& message) {
    arguments.insert(arguments.begin(), "navigate");
    arguments.insert(arguments.end(), {"-o", *folder_ / "refused"});
    EXPECT_THAT(run(arguments, kBadInput), HasSubstr(message));
    EXPECT_FALSE(std::filesystem::exists(*folder_ / "refused.nav"));
    EXPECT_FALSE(std::filesystem::exists(*folder_ / "refused_sigmas.txt"));
  }
  static std::string file_with(const std::string& name, const std::string& text) {
    std::ofstream(*folder_ / name) << text;
    return *folder_ / name;
  }
  static void expect_refusal_of_imu_text(const std::string& text, const std::string& message) {
    expect_refusal({"--imu", file_with("bad.txt", text), "--gnss", *folder_ / "gnss.txt", "--parameters", kParameters},
                   "bad.txt: " + message);
  }
  static void expect_refusal_of_gnss_text(const std::string& text, const std::string& message) {
    expect_refusal({"--imu", *folder_ / "imu.txt", "--gnss", file_with("bad.txt", text), "--parameters", kParameters},
                   "bad.txt: " + message);
  }

  static inline const std::string kScenario = source("tests/data/reference_nav.json");
  static inline const std::string kParameters = source("tests/data/reference_nav_parameters.json");
  static inline TestFolder* folder_ = nullptr;
};

/// That the files `stem`.nav and `stem`_sigmas.txt say what the app of a log said.
void expect_the_apps_solutions(const std::string& stem, const std::string& log) {
  const Rows rows = numbers_of(stem + ".nav"), sigmas = numbers_of(stem + "_sigmas.txt");
  std::vector<NavSolution> solutions = samples_of_kind<NavSolution>(log, "inslab/nav");
  solutions.erase(std::remove_if(solutions.begin(), solutions.end(),
                                 [](const NavSolution& s) { return s.mode == NavMode::Aligning; }),
                  solutions.end());
  ASSERT_GT(solutions.size(), 1500U);
  ASSERT_EQ(rows.size(), solutions.size());
  ASSERT_EQ(sigmas.size(), solutions.size());
  // Half of the last decimal as printed: 12 of latitude and longitude, 6 of height, velocity and their sigmas, 9 of
  // the attitude's; and the rounding of degrees.
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 11U);
    ASSERT_EQ(sigmas[i].size(), 11U);
    const NavSolution& s = solutions[i];
    ASSERT_EQ(rows[i][0], s.gps_week);
    ASSERT_NEAR(rows[i][1], time::to_seconds(s.gps_time_of_week_ns), 1e-9);
    ASSERT_NEAR(rows[i][2], s.latitude_rad / units::kDeg, 0.51e-12);
    ASSERT_NEAR(rows[i][3], s.longitude_rad / units::kDeg, 0.51e-12);
    ASSERT_NEAR(rows[i][4], s.height_m, 0.51e-6);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<Eigen::Index>(axis);
      ASSERT_NEAR(rows[i][5 + axis], s.v_n[a], 0.51e-6);
      ASSERT_NEAR(sigmas[i][2 + axis], s.position_sigma_ned_m[a], 0.51e-6);
      ASSERT_NEAR(sigmas[i][5 + axis], s.velocity_sigma_ned_m_per_s[a], 0.51e-6);
      ASSERT_NEAR(sigmas[i][8 + axis], s.attitude_sigma_rad[a] / units::kDeg, 0.51e-9);
    }
  }
}

TEST_F(Navigate, OnALogGivesTheSolutionsOfTheAppThatTookPart) {
  const std::string said = run({"navigate", log(), "--scenario", kScenario, "-o", *folder_ / "again"});
  EXPECT_THAT(said, HasSubstr("latency: not judged, the app ran on a log"));
  EXPECT_THAT(said, HasSubstr("1 outage; largest error in each"));
  expect_the_apps_solutions(*folder_ / "again", log());
}

TEST_F(Navigate, OnALogTakesTheOtherSensorsThatTheAppTook) {
  for (const std::string name : {"reference_nav_magnetometer", "reference_nav_aided"}) {
    const std::string scenario = source("tests/data/" + name + ".json");
    run({"simulate", scenario, "-o", *folder_ / "."});
    const std::string log = *folder_ / (name + ".mcap");
    run({"navigate", log, "--scenario", scenario, "-o", *folder_ / name});
    expect_the_apps_solutions(*folder_ / name, log);
  }
}

// scored.json names the same sensors and no app. The first of 2000 samples is where the filter begins.
TEST_F(Navigate, BeginsAtTheTruthWithParametersThatMatchAScenariosSensors) {
  EXPECT_THAT(run({"navigate", log(), "--scenario", source("tests/data/scored.json"), "--start-at-truth", "-o",
                   *folder_ / "matched"}),
              HasSubstr("1999 solutions in "));
}

// Positions alone, as text: at the end, at a fix, the filter knows its place better than that fix does, and is within
// five of its own sigmas of the truth.
TEST_F(Navigate, OnTextFilesWritesElevenColumnsThatAgreeWithTheTruthToTheirSigmas) {
  run({"navigate", "--imu", *folder_ / "imu.txt", "--gnss", *folder_ / "gnss.txt", "--parameters", kParameters,
       "--week", "2446", "-o", *folder_ / "text"});
  const Rows rows = numbers_of(*folder_ / "text.nav"), sigmas = numbers_of(*folder_ / "text_sigmas.txt");
  ASSERT_GT(rows.size(), 1500U);
  const TruthState truth = samples_of<TruthState>(log(), "inslab/truth").back();
  const std::vector<double>& last = rows.back();
  ASSERT_EQ(last.size(), 11U);
  EXPECT_EQ(last[0], 2446.0);
  EXPECT_NEAR(last[1], time::to_seconds(truth.header.gps_time_of_week_ns), 1e-9);
  const double m_per_rad = 6.37e6;
  const double north_m = (last[2] * units::kDeg - truth.latitude_rad) * m_per_rad;
  const double east_m = (last[3] * units::kDeg - truth.longitude_rad) * m_per_rad * std::cos(truth.latitude_rad);
  const double down_m = truth.height_m - last[4];
  EXPECT_LT(std::abs(north_m), 5.0 * sigmas.back()[2]);
  EXPECT_LT(std::abs(east_m), 5.0 * sigmas.back()[3]);
  EXPECT_LT(std::abs(down_m), 5.0 * sigmas.back()[4]);
  const std::vector<double> fix = numbers_of(*folder_ / "gnss.txt").back();
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_LT(sigmas.back()[2 + axis], fix[4 + axis]);
}

TEST_F(Navigate, RefusesLogsThatAreNoneOrLackASensor) {
  expect_refusal({*folder_ / "nothing.mcap", "--parameters", kParameters}, "nothing.mcap: cannot open: No such file");
  expect_refusal({kScenario, "--parameters", kParameters}, "expected the magic bytes of an MCAP file");
  expect_refusal(
      {log(), "--parameters", kParameters, "--imu-number", "3"},
      "reference_nav.mcap: has no topic inslab/imu/3 of the type inslab::v5::ImuSample; it has inslab/truth");
  expect_refusal({log(), "--parameters", kParameters, "--gnss-number", "3"},
                 "reference_nav.mcap: has no topic inslab/gnss/3 of the type inslab::v5::GnssFix");
  expect_refusal({log(), "--parameters", kParameters, "--imu-number", "3", "--start-at-truth"},
                 "reference_nav.mcap: has no topic inslab/imu_truth/3 of the type inslab::v5::ImuTruth");
}

TEST_F(Navigate, RefusesImuTextsNamingFileAndLine) {
  expect_refusal({"--imu", *folder_ / "nothing.txt", "--gnss", *folder_ / "gnss.txt", "--parameters", kParameters},
                 "nothing.txt: cannot open: No such file");
  const std::string good = "# comment\n1 0 0 0 0 0 -0.05\n";
  expect_refusal_of_imu_text(good + "1.005 0 0 0 0 0\n", "line 3: has 6 fields; expected 7");
  expect_refusal_of_imu_text(good + "1.005 0 0 0 0 0 -0.05 1\n", "line 3: has 8 fields; expected 7");
  expect_refusal_of_imu_text(good + "1.005 0 O 0 0 0 -0.05\n", "line 3, column 3: is 'O'; expected a finite number");
  expect_refusal_of_imu_text(good + "1.005 0 0 0 0 nan -0.05\n",
                             "line 3, column 6: is 'nan'; expected a finite number");
  expect_refusal_of_imu_text(good + "1.005 0 0 0 inf 0 -0.05\n",
                             "line 3, column 5: is 'inf'; expected a finite number");
  expect_refusal_of_imu_text(good + "0.995 0 0 0 0 0 -0.05\n", "line 3, column 1: is 0.995000 after 1.000000");
  expect_refusal_of_imu_text(good + "1 0 0 0 0 0 -0.05\n", "line 3, column 1: is 1.000000 after 1.000000");
  expect_refusal_of_imu_text(good + "604801 0 0 0 0 0 -0.05\n",
                             "line 3, column 1: is 604801.000000; expected seconds of week from 0");
  expect_refusal_of_imu_text(good, "has no interval; expected at least two lines of 7 numbers");
  expect_refusal_of_imu_text("", "has no interval; expected at least two lines of 7 numbers");
}

TEST_F(Navigate, RefusesGnssTextsNamingFileAndLine) {
  expect_refusal({"--imu", *folder_ / "imu.txt", "--gnss", *folder_ / "nothing.txt", "--parameters", kParameters},
                 "nothing.txt: cannot open: No such file");
  const std::string good = "36000.1 48.1 11.6 520 0.1 0.1 0.2\n";
  expect_refusal_of_gnss_text(good + "36000.2 48.1 11.6\n", "line 2: has 3 fields; expected 7");
  expect_refusal_of_gnss_text(good + "36000.2 48.1 E11.6 520 0.1 0.1 0.2\n", "line 2, column 3: is 'E11.6'; expected");
  expect_refusal_of_gnss_text(good + "36000.2 48.1 nan 520 0.1 0.1 0.2\n", "line 2, column 3: is 'nan'; expected");
  expect_refusal_of_gnss_text(good + "36000.2 95 11.6 520 0.1 0.1 0.2\n", "line 2: ");
  expect_refusal_of_gnss_text(good + "36000.2 48.1 11.6 200000 0.1 0.1 0.2\n", "line 2: ");
  expect_refusal_of_gnss_text(good + "36000 48.1 11.6 520 0.1 0.1 0.2\n",
                              "line 2, column 1: is 36000.000000 after 36000.100000; expected time to go on");
  expect_refusal_of_gnss_text("% nothing\n", "has no fix; expected at least one line of 7 numbers");
}

TEST_F(Navigate, RefusesArgumentsThatDoNotBelongTogether) {
  expect_refusal({"--parameters", kParameters}, "give a log, or --imu and --gnss");
  expect_refusal({log()}, "give the filter's --parameters, or the --scenario whose sensors it is to match");
  expect_refusal({"--imu", *folder_ / "imu.txt", "--parameters", kParameters}, "--imu requires --gnss");
  expect_refusal({"--gnss", *folder_ / "gnss.txt", "--parameters", kParameters}, "--gnss requires --imu");
  expect_refusal({log(), "--imu", *folder_ / "imu.txt", "--gnss", *folder_ / "gnss.txt", "--parameters", kParameters},
                 "excludes");
}

TEST_F(Navigate, RefusesParametersNamingFileAndPath) {
  expect_refusal({log(), "--parameters", *folder_ / "nothing.json"}, "nothing.json: cannot be read: No such file");
  expect_refusal({log(), "--parameters", source("config/invalid/nav_rest_thresholds.json")},
                 "nav_rest_thresholds.json: zero_velocity.speed_m_per_s: is 0");
  expect_refusal({log(), "--scenario", kScenario, "--imu-number", "3"}, "reference_nav.json: imu: has no IMU number 3");
}

TEST_F(Navigate, SaysWhyThereIsNoSolutionAndFails) {
  // Ten seconds of rest are too few to align, and there is no motion to begin by.
  run({"simulate", source("tests/data/reference_nav_at_rest.json"), "-o", *folder_ / "."});
  const std::string parameters =
      file_with("static.json", R"({"name": "static", "initial": {"attitude": "static_alignment"}})");
  const std::string at_rest = *folder_ / "reference_nav_at_rest.mcap";
  EXPECT_THAT(run({"navigate", at_rest, "--parameters", parameters, "-o", *folder_ / "none"}, 1),
              HasSubstr("inslab navigate: no solution: "));
}

}  // namespace navigate_test
}  // namespace inslab::e2e
