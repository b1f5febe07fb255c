// The commands `inslab predict`, `inslab align`, `inslab allan` and `inslab graft`, as a user calls them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/e2e/process.hpp"

namespace inslab::e2e {
namespace predict_align_test {

using std::chrono::seconds;
using testing::HasSubstr;
using testing::Not;

constexpr int kBadInput = 2;

std::string inslab(const std::vector<std::string>& arguments, int expected = 0) {
  Process command("inslab", arguments);
  EXPECT_EQ(command.wait(seconds(60)), expected) << command.output();
  return command.output();
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A folder with scenarios in it.
class Commands : public testing::Test {
 protected:
  std::string put(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  /// 200 Hz, one IMU; `motions` of the one segment.
  std::string scenario(const std::string& name, const std::string& imu_profile, double duration_s,
                       const std::string& motions, const std::string& more = "") {
    std::ostringstream text;
    text << R"({"name": ")" << name << R"(", "seed": 3, "start": {"at": "gps_time", "gps_week": 2400,
      "gps_seconds_of_week_s": 0}, "duration_s": )"
         << duration_s
         << R"(, "truth_rate_hz": 200, "trajectory": {"initial": {"latitude_deg": 30.53, "longitude_deg": 0,
      "height_m": 0, "speed_m_per_s": 0, "yaw_deg": 45}, "segments": [{"duration_s": )"
         << duration_s << motions << R"(}]}, "imu": [{"number": 0, "rate_hz": 200, "error_profile": ")" << imu_profile
         << R"("}])" << more << "}";
    return put(name + ".json", text.str());
  }

  TestFolder folder_;
};

class Predict : public Commands {
 protected:
  /// Rows of NAME_predicted.csv.
  std::vector<std::vector<double>> rows(const std::string& name) {
    std::ifstream file(folder_ / (name + "_predicted.csv"));
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(file, line);
    EXPECT_THAT(line, testing::StartsWith("time_s,position_north_m,position_east_m,position_down_m,"));
    while (std::getline(file, line)) {
      std::istringstream fields(line);
      rows.emplace_back();
      for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
    }
    return rows;
  }
  std::vector<double> row_at(const std::string& name, double time_s) {
    for (const auto& row : rows(name)) {
      if (row[0] >= time_s - 1e-6) return row;
    }
    ADD_FAILURE() << "no row at " << time_s << " s";
    return std::vector<double>(10, 0.0);
  }
};

TEST_F(Predict, AnAccelerometersBiasGrowsWithTheSquareOfTime) {
  const std::string imu = put("biased.json", R"({"name": "biased", "accel": {"bias_constant_mgal": 10}})");
  const std::string file = scenario("rest", imu, 100.0, "");
  EXPECT_THAT(inslab({"predict", file, "--overwrite", "-o", folder_ / "."}),
              HasSubstr("rest: free inertial navigation with imu 0, height free, 1 sigma"));
  // 1e-4 m/s^2 for 100 s along every axis; (omega_Schuler t)^2 / 12 = 0.13 % less, of the height as much twice more.
  const std::vector<double> end = rows("rest").back();
  EXPECT_NEAR(end[0], 100.0, 1e-6);
  for (const int axis : {1, 2}) EXPECT_NEAR(end[axis], 0.5, 0.002 * 0.5);
  EXPECT_NEAR(end[3], 0.5, 0.003 * 0.5);
  EXPECT_THAT(text_of(folder_ / "rest_predicted.svg"), HasSubstr("</svg>"));
  inslab({"predict", file, "--overwrite", "-o", folder_ / ".", "--hold-vertical", "--position", "3"});
  EXPECT_EQ(rows("rest").back()[3], 0.0);
  EXPECT_NEAR(rows("rest").front()[1], 3.0, 1e-9);
}

TEST_F(Predict, FixesBoundTheErrorsButForOutagesAndSwapsCount) {
  const std::string imu = put("quiet.json", R"({"name": "quiet", "accel": {"vrw_m_per_s_per_sqrt_h": 0.01}})");
  put("shaky.json", R"({"name": "shaky", "accel": {"bias_turn_on_sigma_mgal": 10000}})");
  put("fixes.json", R"({"name": "fixes", "fix_type": "fixed", "position_sigma_ned_m": 0.1,
                        "velocity_sigma_ned_m_per_s": 0.1})");
  const std::string file = scenario("cut", imu, 30.0, "", R"(, "gnss": [{"number": 0, "rate_hz": 10, "error_profile":
    "fixes.json", "outages": [{"start_s": 10, "duration_s": 5}, {"start_s": 20, "duration_s": 5}]}], "swaps": [{"at_s":
    17, "kind": "imu_error", "sensor_kind": "imu", "sensor_number": 0, "profile": "shaky.json"}])");
  EXPECT_THAT(inslab({"predict", file, "--overwrite", "-o", folder_ / "."}),
              HasSubstr("the best filter of the fixes of gnss 0"));
  const double before = row_at("cut", 9.5)[1], outage = row_at("cut", 14.8)[1], after = row_at("cut", 16.5)[1],
               swapped = row_at("cut", 24.8)[1];
  EXPECT_LT(before, 0.05);
  EXPECT_GT(outage, 1.1 * before);
  EXPECT_LT(after, 0.05);
  EXPECT_GT(swapped, 3.0 * outage);
  inslab({"predict", file, "--overwrite", "-o", folder_ / ".", "--free-inertial"});
  // 0.1 m/s^2 from 17 s on.
  EXPECT_NEAR(rows("cut").back()[1], 0.05 * 13.0 * 13.0, 0.05 * 0.05 * 13.0 * 13.0);
}

TEST_F(Predict, NamesTheTermsThatItLeavesOut) {
  const std::string file = scenario("all", source("config/profiles/imu/every_term.json"), 2.0, "");
  EXPECT_THAT(
      inslab({"predict", file, "--overwrite", "-o", folder_ / "."}),
      HasSubstr(
          "left out: bandwidth, full scale, quantization, latency, dropped samples, delay of a triad, size effect, "));
}

TEST_F(Predict, ShowsTheSignedResponseAtRestBesideTheClosedForms) {
  const std::string printed = inslab({"predict", "--source", "gyro_bias_e=0.01deg/h", "--source", "accel_bias_d=-1mGal",
                                      "--latitude", "-45", "--hours", "1", "--overwrite", "-o", folder_ / "."});
  EXPECT_THAT(printed, HasSubstr("rest at latitude -45 deg: signed response, height free"));
  EXPECT_THAT(printed, HasSubstr("gyro_bias_e=0.01deg/h, m\n"));
  const std::string rows = text_of(folder_ / "rest_response.csv");
  EXPECT_THAT(rows, HasSubstr("closed_68_north_m,closed_68_east_m,closed_72_height_m,closed_73_height_m\n"));
  EXPECT_THAT(rows, HasSubstr("\n\"accel_bias_d=-1mGal\",3600,"));
  EXPECT_THAT(text_of(folder_ / "rest_response.svg"), HasSubstr("</svg>"));
}

TEST_F(Predict, FollowsASourceAndWritesTheModelAlongAScenario) {
  const std::string file = scenario("moves", source("config/profiles/imu/ideal.json"), 4.0,
                                    R"(, "motions": [{"type": "target_speed", "final_speed_m_per_s": 5}])");
  inslab({"predict", file, "--source", "gyro_bias_x=1deg/h", "--model", folder_ / "model.csv", "--overwrite", "-o",
          folder_ / "."});
  EXPECT_THAT(text_of(folder_ / "model.csv"), testing::ContainsRegex("^end_s,dt_s,.*Phi\\.phi_d\\.phi_d\n0\\.2"));
  EXPECT_THAT(text_of(folder_ / "moves_response.csv"), HasSubstr("\n\"gyro_bias_x=1deg/h\",4,"));
  inslab({"predict", "--latitude", "30", "--model", folder_ / "model.h5", "--hours", "0.1"});
  EXPECT_THAT(text_of(folder_ / "model.h5").substr(1, 3), "HDF");
}

TEST_F(Predict, RefusesASourceThatItDoesNotKnow) {
  EXPECT_THAT(inslab({"predict", "--latitude", "30", "--source", "gyro_e=1deg/h"}, kBadInput),
              HasSubstr("is of none of position, velocity, phi, accel_bias, gyro_bias"));
  EXPECT_THAT(inslab({"predict", "--source", "gyro_bias_e=1deg/h"}, kBadInput),
              HasSubstr("expected a scenario, or --latitude with --source or --model"));
}

TEST_F(Predict, RefusesWhatItCannotPredict) {
  EXPECT_THAT(inslab({"predict", folder_ / "none.json"}, kBadInput), HasSubstr("none.json"));
  EXPECT_THAT(inslab({"predict", source("config/invalid/truncated.json")}, kBadInput), HasSubstr("truncated.json"));
  const std::string file = scenario("one", source("config/profiles/imu/ideal.json"), 2.0, "");
  EXPECT_THAT(inslab({"predict", file, "--sensor", "4"}, kBadInput), HasSubstr("has no IMU number 4"));
  EXPECT_THAT(inslab({"predict", file, "--yaw", "-1"}, kBadInput), HasSubstr("--yaw"));
}

class Align : public Commands {
 protected:
  /// RAWIMUSXA lines of a run.
  std::string recorded(const std::string& name, const std::string& motions) {
    const std::string file = scenario(name, source("config/profiles/imu/ideal.json"), 5.0, motions);
    inslab({"simulate", file, "--overwrite", "-o", folder_ / "."});
    inslab({"export", folder_ / (name + ".mcap"), "--format", "novatel", "-o", folder_ / (name + ".asc")});
    return folder_ / (name + ".asc");
  }
  void expect_refusal(const std::string& file, const std::string& message,
                      const std::vector<std::string>& more = {"--latitude", "30.53"}) {
    std::vector<std::string> arguments{"align", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(inslab(arguments, kBadInput), HasSubstr(message));
  }
};

TEST_F(Align, FindsTheAttitudeOfAnIdealImuAndCountsADamagedLine) {
  const std::string file = recorded("rest", "");
  std::string lines = text_of(file);
  const std::size_t star = lines.find('*', lines.find('\n') + 1);
  lines.replace(star + 1, 8, "ffffffff");  // the CRC of line 2
  put("rest.asc", lines);
  const std::string printed = inslab({"align", file, "--latitude", "30.53", "--plot", folder_ / "rest.svg"});
  EXPECT_THAT(printed, HasSubstr("line 2 left out: has the CRC ffffffff; expected "));
  EXPECT_THAT(printed, HasSubstr("999 samples of 0.005"));
  // Half a count of each gyro over 5 s turns yaw by less than 0.01 deg.
  EXPECT_THAT(printed, testing::ContainsRegex("whole span +1 +-?0\\.000[0-9] +-?0\\.000[0-9] +4[45]\\.[09]"));
  EXPECT_THAT(text_of(folder_ / "rest.svg"), HasSubstr("</svg>"));
}

TEST_F(Align, SaysHowWellYawIsKnownAndWarnsOfATacticalGyro) {
  const std::string imu = put("tactical_imu.json", R"({"name": "tactical", "gyro": {"bias_constant_deg_per_h": 5.5}})");
  const std::string file = scenario("tactical", imu, 12.0, "");
  inslab({"simulate", file, "--overwrite", "-o", folder_ / "."});
  const std::string printed =
      inslab({"align", folder_ / "tactical.mcap", "--latitude", "30.53", "--wanted-yaw", "0.1"});
  EXPECT_THAT(printed, HasSubstr("Yaw's standard deviation: "));
  EXPECT_THAT(printed, HasSubstr("tactical.mcap: yaw is not known: its standard deviation is "));
  EXPECT_THAT(printed, HasSubstr("0.1 deg of yaw needs gyros of 0.023 deg/h: aviation grade (0.01 deg/h)"));
  EXPECT_THAT(inslab({"align", recorded("rest", ""), "--latitude", "30.53"}), Not(HasSubstr("yaw is not known")));
}

TEST_F(Align, RefusesAPoleAndAMovingImu) {
  expect_refusal(recorded("rest", ""), "no alignment: latitude 89.5 deg is within 1 deg of a pole",
                 {"--latitude", "89.5"});
  expect_refusal(recorded("moving", R"(, "motions": [{"type": "sine_accel", "amplitude_m_per_s2": 2, "period_s": 2}])"),
                 "the IMU was moving");
}

TEST_F(Align, RefusesWhatHoldsNoImuSamples) {
  expect_refusal(folder_ / "none.asc", "none.asc");
  expect_refusal(put("empty.asc", ""), "empty.asc");
  expect_refusal(put("words.txt", "these are words\n"), "words.txt: line 1");
  expect_refusal(put("aligning.asc",
                     "#INSPVAXA,COM1,0,73.0,FINESTEERING,1815,413059.500,00000000,4e14,12996;INS_ALIGNING,NONE,0\n"),
                 "no line is a good IMU sample (RAWIMUSA, RAWIMUSXA, RAWIMUA, RAWIMUXA); 1 lines are of other messages "
                 "(INSPVAXA), 0 are bad");
  expect_refusal(put("short.asc", "<RAWIMUX ICOM7 0 68.5 FINESTEERING 2222 136132.845 02040120 0dc5 16860\n"),
                 "line 1 is NovAtel's abbreviated ASCII (<), which has no CRC; expected RAWIMUSXA or RAWIMUXA lines");
  expect_refusal(put("wrong.asc",
                     "%RAWIMUSXA,2400,1.000;00,26,2400,1.000000000,00000000,9797789,-42574,-808,-7225,-16052,-10644*"
                     "00000000\n"),
                 "1 are bad, the first is line 1: has the CRC 00000000; expected ");
  expect_refusal(put("slow.asc",
                     "%RAWIMUSXA,2400,1.000;00,26,2400,1.000000000,00000000,9797789,0,0,0,0,0\n"
                     "%RAWIMUSXA,2400,1.010;00,26,2400,1.010000000,00000000,9797789,0,0,0,0,0\n"),
                 "slow.asc: samples are 0.01 s apart at least; expected 0.005 s of IMU type 26");
  expect_refusal(put("site.asc", ""), "--latitude", {"--latitude", "91"});
}

/// The files that the real receivers gave, where they are.
TEST_F(Align, SaysWhyARealReceiversFileGivesNoAttitude) {
  const std::string folder = std::string(INSLAB_SOURCE_DIR) + "/../shared/data/novatel/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "shared/data/novatel is not here";
  const std::vector<std::string> site{"--latitude", "51.15"};
  expect_refusal(folder + "edie_abbrev_rawimux.txt", "line 1 is NovAtel's abbreviated ASCII", site);
  expect_refusal(folder + "edie_test_lines.txt", "line 4 is of IMU type 11; expected 41", site);
  expect_refusal(folder + "propak6_aligning_INSPVAXA_derived.asc", "other messages (INSPVAXA)", site);
  expect_refusal(folder + "propak6_ins_INSPVAXA_derived.asc", "other messages (INSPVAXA)", site);
}

/// White noise, at rest, and a hum that no model has.
TEST_F(Commands, AllanWritesNoTwinOfAPoorFitUnasked) {
  std::ostringstream hums, rests;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 20'000; ++k) {
    const double t_s = 0.01 * k, hum = 0.02 * std::sin(2.0 * 3.14159265358979 * 0.5 * t_s);
    const double gyro = 1e-3 * normal(random), accel = 9.8 + 0.01 * normal(random);
    for (std::ostringstream* out : {&hums, &rests}) {
      *out << (k == 0 ? "time_s,gyro_x_rad_per_s,accel_z_m_per_s2\n" : "") << t_s << ','
           << gyro + (out == &hums ? hum : 0.0) << ',' << accel << '\n';
    }
  }
  const std::string hum = put("hum.csv", hums.str()), rest = put("rest.csv", rests.str()), twin = folder_ / "twin.json";
  EXPECT_THAT(inslab({"allan", rest, "--profile", twin}), HasSubstr("twin.json written"));
  EXPECT_TRUE(std::filesystem::remove(twin));
  EXPECT_THAT(inslab({"allan", hum, "--profile", twin}, 1), HasSubstr("--accept-poor-fit writes it nevertheless"));
  EXPECT_FALSE(std::filesystem::exists(twin));
  EXPECT_THAT(inslab({"allan", hum, "--profile", twin, "--accept-poor-fit", "--overwrite"}),
              HasSubstr("twin.json written"));
  EXPECT_TRUE(std::filesystem::exists(twin));
}

/// `inslab graft` as a user calls it: out of a recording, into a profile, onto another motion.
class Graft : public Commands {
 protected:
  std::string simulated(const std::string& file, const std::string& name) {
    inslab({"simulate", file, "-o", folder_ / "logs", "--overwrite"});
    return folder_ / ("logs/" + name + ".mcap");
  }
};

TEST_F(Graft, ARecordingAtRestIsPutOntoAnotherMotion) {
  const std::string imu = put("noisy.json", R"({"name": "noisy", "gyro": {"arw_deg_per_sqrt_h": 0.1}, "accel":
    {"vrw_m_per_s_per_sqrt_h": 0.05, "bias_constant_mgal": [0, 0, 70]}})");
  const std::string still = simulated(scenario("still", imu, 120.0, ""), "still");
  std::filesystem::create_directory(folder_ / "recordings");
  const std::string recording = folder_ / "recordings/mine.mcap";
  EXPECT_THAT(
      inslab({"graft", "extract", still, "--latitude", "30.53", "-o", recording, "--basic", folder_ / "mine.json"}),
      testing::AllOf(HasSubstr("Not observable at rest"), HasSubstr("24000 samples at 200 Hz, 120.000 s"),
                     HasSubstr("sha256")));
  EXPECT_THAT(inslab({"graft", "check", recording}), HasSubstr("at rest, less the Earth's rate and gravity"));
  const std::string moving = scenario("moving", folder_ / "mine.json", 60.0, R"(, "motions": [{"type": "constant_rate",
    "axis": "z", "rate_deg_per_s": 3}])",
                                      R"(, "recordings_folder": "recordings")");
  const std::string log = simulated(moving, "moving");
  // Its own noise is what the profile's was.
  EXPECT_THAT(inslab({"graft", "extract", log, "--minus-truth", "-o", folder_ / "again.mcap"}), HasSubstr("60.000 s"));
  EXPECT_THAT(inslab({"allan", folder_ / "again.mcap", "--term", "white", "-o", folder_ / "."}),
              testing::ContainsRegex("0\\.(09[5-9]|10[0-5])"));
}

TEST_F(Graft, AnOffsetThatIsGivenMovesTheRecordingHoweverMuch) {
  const std::string log = simulated(scenario("turns", put("ideal.json", R"({"name": "ideal"})"), 20.0,
                                             R"(, "motions": [{"type": "constant_rate", "rate_deg_per_s": 3}])"),
                                    "turns");
  inslab({"export", log, "--format", "imu", "-o", folder_ / "imu.txt"});
  std::ifstream in(folder_ / "imu.txt");
  std::ofstream later(folder_ / "later.txt");
  std::string line;
  while (std::getline(in, line)) {
    const std::size_t end = line.find(' ');
    later << std::fixed << std::stod(line.substr(0, end)) + 100.0 << line.substr(end) << "\n";
  }
  later.close();
  const std::vector<std::string> command{"graft", "extract", folder_ / "later.txt", "--reference",
                                         log,     "-o",      folder_ / "e.mcap",    "--keep-geometry"};
  EXPECT_THAT(inslab(command, kBadInput), HasSubstr("--time-offset moves the recording"));
  std::vector<std::string> moved = command;
  moved.insert(moved.end(), {"--time-offset", "-100"});
  EXPECT_THAT(inslab(moved), testing::AllOf(HasSubstr("time offset  -100.000000 s"), HasSubstr("3600 samples")));
}

TEST_F(Graft, SaysWhatIsMissing) {
  const std::string still = simulated(scenario("still", put("ideal.json", R"({"name": "ideal"})"), 20.0, ""), "still");
  EXPECT_THAT(inslab({"graft", "extract", still, "-o", folder_ / "x.mcap"}, kBadInput),
              HasSubstr("one of --latitude (it stood still), --reference (it moved) and --minus-truth is needed"));
  EXPECT_THAT(inslab({"graft", "check", still}, kBadInput),
              HasSubstr("does not say that it holds the errors of an IMU"));
  const std::string profile =
      put("gone.json",
          R"({"name": "gone", "recorded_error": {"file": "gone.mcap", "sha256": ")" + std::string(64, 'a') + R"("}})");
  EXPECT_THAT(
      inslab({"simulate", scenario("lacks", profile, 20.0, ""), "-o", folder_ / "logs"}, kBadInput),
      testing::AllOf(HasSubstr("lacks.json: imu[0].error_profile: names a profile whose recorded_error cannot be had"),
                     HasSubstr("gone.mcap: is not there")));
}

}  // namespace predict_align_test
}  // namespace inslab::e2e
