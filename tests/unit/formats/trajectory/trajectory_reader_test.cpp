#include "inslab/formats/trajectory/trajectory_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "inslab/formats/log/log_channel.hpp"
#include "inslab/formats/recordings/nav_text.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::trajectory {
namespace trajectory_reader_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class TrajectoryReader : public test::TemporaryFolder {
 protected:
  TrajectoryReading read(const std::string& text, const TrajectoryReadOptions& options = {}) {
    put(path("rows"), text);
    return read_trajectory(path("rows"), options);
  }

  /// The first problem as "place: reason".
  std::string problem_of(const std::string& text, const TrajectoryReadOptions& options = {}) {
    const TrajectoryReading reading = read(text, options);
    if (reading.problems.empty()) return "none";
    const Violation& first = reading.problems.kept().front();
    return first.path + ": " + first.reason;
  }
};

constexpr const char* kTwoRows = "0.0,30,114,20\n0.1,30,114,20\n";

TEST_F(TrajectoryReader, ReadsTheElevenColumns) {
  const TrajectoryReading reading = read(
      "2209 491674.013699 30.528462391500 -114.355736303800 21.019000 1.5 -2.5 0.25 -0.229930000 0.239870000 179.5\n"
      "2209 491674.106595 30.528462397400 -114.355736502500 21.006400 1.5 -2.5 0.25 -0.249440000 0.226630000 "
      "359.5\r\n");
  ASSERT_TRUE(reading.problems.empty());
  EXPECT_EQ(reading.file.start, (time::GpsTime{2209, 491'674'013'699'000}));
  ASSERT_EQ(reading.file.rows.size(), 2U);
  const TrajectoryRow& row = reading.file.rows[0];
  EXPECT_DOUBLE_EQ(row.position.latitude_rad, 30.5284623915 * units::kDeg);
  EXPECT_DOUBLE_EQ(row.position.longitude_rad, -114.3557363038 * units::kDeg);
  EXPECT_EQ(row.position.height_m, 21.019);
  EXPECT_EQ(row.v_n.value(), nav::Vector3(1.5, -2.5, 0.25));
  EXPECT_DOUBLE_EQ(row.rpy.value().yaw_rad, 179.5 * units::kDeg);
  EXPECT_EQ(reading.file.rows[1].time.count(), 92'896'000);
}

TEST_F(TrajectoryReader, ReadsNamedColumnsInAnyOrderAndUnit) {
  const TrajectoryReading reading = read(
      "h_m,longitude_deg,lat_rad,yaw_deg,pitch_rad,roll_deg,vu_mps,ve_mps,vn_mps,t_ms\n"
      "20,190,0.5,90,0.25,1,3,2,1,1000\n"
      "20,190,0.5,90,0.25,1,3,2,1,1000.5\n");
  ASSERT_TRUE(reading.problems.empty()) << reading.problems.kept().front().reason;
  const TrajectoryRow& row = reading.file.rows[0];
  EXPECT_EQ(row.position.latitude_rad, 0.5);
  EXPECT_NEAR(row.position.longitude_rad, -170.0 * units::kDeg, 1e-15);
  EXPECT_EQ(row.v_n.value(), nav::Vector3(1.0, 2.0, -3.0));
  EXPECT_EQ(row.rpy.value().pitch_rad, 0.25);
  EXPECT_EQ(reading.file.rows[1].time.count(), 500'000);
}

TEST_F(TrajectoryReader, TakesNamesFromACommentOrFromTheOptions) {
  EXPECT_EQ(problem_of(std::string("# a receiver\n# t_s,lat_deg,lon_deg,h_m\n") + kTwoRows), "none");
  TrajectoryReadOptions options;
  options.columns = "t_s,lat_deg,lon_deg,h_m";
  EXPECT_EQ(problem_of(kTwoRows, options), "none");
  EXPECT_THAT(problem_of(kTwoRows), HasSubstr("line 1: has 4 numbers and no line of names was above it"));
}

TEST_F(TrajectoryReader, ReadsGnssPositionsWithAndWithoutVelocity) {
  const TrajectoryReading without =
      read("456250.0 30.44 114.47 21.095 0.010 0.009 0.019\n456251.0 30.44 114.47 21.095 0.010 0.009 0.019\n");
  ASSERT_TRUE(without.problems.empty());
  EXPECT_FALSE(without.file.rows[0].v_n.has_value());
  EXPECT_FALSE(without.file.rows[0].rpy.has_value());
  const TrajectoryReading with = read(
      "456250.0 30.44 114.47 21.095 .01 .01 .02 1 2 3 .1 .1 .1\n456251.0 30.44 114.47 21.095 .01 .01 .02 1 2 3 .1 .1 "
      ".1\n");
  ASSERT_TRUE(with.problems.empty());
  EXPECT_EQ(with.file.rows[0].v_n.value(), nav::Vector3(1.0, 2.0, 3.0));
}

TEST_F(TrajectoryReader, GoesOnThroughTheEndOfAnUnknownWeek) {
  const TrajectoryReading reading = read("604799.5 30 114 20 1 1 1\n0.5 30 114 20 1 1 1\n1.5 30 114 20 1 1 1\n");
  ASSERT_TRUE(reading.problems.empty());
  EXPECT_EQ(reading.file.rows[1].time, std::chrono::seconds(1));
  EXPECT_EQ(reading.file.rows[2].time, std::chrono::seconds(2));
}

TEST_F(TrajectoryReader, NamesLineColumnAndWhatWasExpected) {
  const std::string names = "t_s,lat_deg,lon_deg,h_m\n";
  const std::string good = "0,30,114,20\n";
  EXPECT_EQ(problem_of(names + good + "1,30,x,20\n"), "line 3, column 3 (lon_deg): is 'x'; expected a number");
  EXPECT_EQ(problem_of(names + good + "1,30,,20\n"), "line 3, column 3 (lon_deg): is ''; expected a number");
  EXPECT_EQ(problem_of(names + good + "1,30,1e999,20\n"), "line 3, column 3 (lon_deg): is '1e999'; expected a number");
  EXPECT_EQ(problem_of(names + good + "1,nan,114,20\n"),
            "line 3, column 2 (lat_deg): is nan; expected a finite number");
  EXPECT_EQ(problem_of(names + good + "1,30,114,-inf\n"), "line 3, column 4 (h_m): is -inf; expected a finite number");
  EXPECT_EQ(problem_of(names + good + "1,89.95,114,20\n"),
            "line 3, column 2 (lat_deg): is 89.95 deg; expected -89.9 to 89.9");
  EXPECT_EQ(problem_of(names + good + "1,30,114\n"), "line 3: has 3 fields; expected 4");
  EXPECT_EQ(problem_of(names + good + "0,30,114,20\n"),
            "line 3, column 1 (t_s): lies 0 s before the row above it; expected time to increase");
  EXPECT_EQ(problem_of(names + good), ": has 1 rows; expected at least 2");
  EXPECT_EQ(problem_of("t_s,lat_deg,lat_rad,lon_deg,h_m\n0,1,1,1,1\n"),
            "line 1: has 'lat_rad' beside 'lat_deg'; expected each once");
  EXPECT_THAT(problem_of("t_s,lat_deg,lon_deg,alt_msl_m\n"), HasSubstr("line 1: column 4 is 'alt_msl_m'; expected"));
  EXPECT_THAT(problem_of("t_s,lat_deg,lon_deg,h_m,roll_deg\n"), HasSubstr("line 1: expected all three angles or none"));
  EXPECT_THAT(problem_of("lat_deg,lon_deg,h_m\n"), HasSubstr("line 1: expected one column of time"));
}

TEST_F(TrajectoryReader, KnowsTheStepOfTheLastDecimal) {
  put(path("rows"), "t_s,lat_deg,lon_deg,h_m\n0,48.00001,11,500\n1,48.0000212,11.0,500.5\n");
  const TrajectoryReading reading = read_trajectory(path("rows"));
  ASSERT_TRUE(reading.problems.empty());
  EXPECT_NEAR(reading.step_ned_m.x(), 1e-7 * 3.14159265358979 / 180.0 * 6378137.0, 1e-9);
  EXPECT_NEAR(reading.step_ned_m.z(), 0.1, 1e-12);
  EXPECT_GT(reading.step_ned_m.y(), 1000.0);  // one decimal of a degree
}

/// With its checksum.
std::string sentence(const std::string& text) {
  unsigned sum = 0;
  for (const char c : text) sum ^= static_cast<unsigned char>(c);
  constexpr char kDigits[] = "0123456789ABCDEF";
  return "$" + text + "*" + kDigits[sum >> 4] + kDigits[sum & 15] + "\r\n";
}

TEST_F(TrajectoryReader, ReadsTheSentencesOfAReceiver) {
  put(path("nmea"), sentence("GPGSV,3,1,11,03,03,111,00") +
                        sentence("GPGGA,235959.50,4807.0380,N,01131.0000,W,4,12,0.8,545.4,M,46.9,M,1.0,0000") +
                        sentence("GPRMC,235959.50,A,4807.038,N,01131.000,W,0.0,0.0,311223,,") +
                        sentence("GPGGA,235959.75,4807.0380,N,01131.0000,W,0,00,,,M,,M,,") +
                        sentence("GPGGA,000000.00,4807.0381,N,01131.0000,W,4,12,0.8,545.5,M,46.9,M,1.0,0000"));
  const TrajectoryReading reading = read_trajectory(path("nmea"), {"", "", false});
  EXPECT_TRUE(reading.problems.empty());
  ASSERT_EQ(reading.file.rows.size(), 2U);
  EXPECT_EQ(reading.file.rows[1].time, std::chrono::milliseconds(500));
  EXPECT_NEAR(reading.file.rows[0].position.latitude_rad, (48.0 + 7.038 / 60.0) * units::kDeg, 1e-12);
  EXPECT_NEAR(reading.file.rows[0].position.longitude_rad, -(11.0 + 31.0 / 60.0) * units::kDeg, 1e-12);
  EXPECT_NEAR(reading.file.rows[0].position.height_m, 592.3, 1e-9);
  // 2023-12-31 23:59:59.5 UTC is a Sunday, 18 s later in GPS time: the second 17.5 of Monday.
  EXPECT_EQ(reading.file.start, (time::GpsTime{2295, 86'417'500'000'000}));
  EXPECT_NEAR(reading.step_ned_m.z(), 0.1, 1e-12);
  EXPECT_NEAR(reading.step_ned_m.x(), 0.1855, 1e-3);  // 1e-4 minutes of a degree
}

TEST_F(TrajectoryReader, NamesTheSentenceThatCannotBeUsed) {
  const std::string good = sentence("GNGGA,101530.00,4807.0380,N,01131.0000,E,1,12,0.8,545.4,M,46.9,M,,");
  const auto problem_of = [&](const std::string& second) {
    put(path("nmea"), good + second);
    const TrajectoryReading reading = read_trajectory(path("nmea"));
    return reading.problems.empty() ? "none"
                                    : reading.problems.kept()[0].path + ": " + reading.problems.kept()[0].reason;
  };
  EXPECT_EQ(problem_of("$GNGGA,101531.00,4807.0380,N,01131.0000,E,1,12,0.8,545.4,M,46.9,M,,*00\n"),
            "line 2: has a checksum that does not fit what it says");
  EXPECT_THAT(problem_of(sentence("GNGGA,101531.00,4807.0380,N,01131.0000,E,1,12,0.8,545.4,M,,M,,")),
              HasSubstr("line 2: has no height of the geoid"));
  EXPECT_THAT(problem_of(sentence("GNGGA,101531.00,48x7.0380,N,01131.0000,E,1,12,0.8,545.4,M,1,M,,")),
              HasSubstr("has no position"));
  EXPECT_THAT(problem_of(good), HasSubstr("line 2, column 1 (t_s): lies 0 s before the row above it"));
}

TEST_F(TrajectoryReader, PassesOverAMarkOfTheByteOrder) {
  put(path("rows"), "\xef\xbb\xbft_s,lat_deg,lon_deg,h_m\n0,48,11,500\n1,48,11,500\n");
  EXPECT_EQ(read_trajectory(path("rows")).file.rows.size(), 2U);
}

TEST_F(TrajectoryReader, RefusesALineThatIsTooLongWhereverItEnds) {
  put(path("long"), "t_s,lat_deg,lon_deg,h_m\n0,48,11," + std::string(70'000, '5') + "\n1,48,11,500\n");
  EXPECT_THROW(read_trajectory(path("long")), files::ReadError);
}

TEST_F(TrajectoryReader, RefusesABinaryFileAtOnce) {
  std::string bytes;
  for (int i = 0; i < 100000; ++i) bytes += static_cast<char>(i % 7 + 1);
  put(path("binary"), bytes);
  EXPECT_THROW(read_trajectory(path("binary")), files::ReadError);
}

TEST_F(TrajectoryReader, LeavesOutBadRowsAndSaysWhichWhenAskedFor) {
  TrajectoryReadOptions all;
  all.stop_at_first = false;
  const TrajectoryReading reading =
      read("t_s,lat_deg,lon_deg,h_m\n0,30,114,20\nx\n1,30,114,20\n1,30,114,20\n2,nan,114,20\n3,30,114,20\n", all);
  EXPECT_THAT(reading.lines, ElementsAre(2, 4, 7));
  std::vector<std::string> rules;
  for (const Violation& problem : reading.problems.kept()) rules.emplace_back(enum_name(problem.rule));
  EXPECT_THAT(rules, ElementsAre("file_columns", "file_time", "value_range"));
}

TEST_F(TrajectoryReader, DoesNotHeedTheLocale) {
  const char* const german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  const TrajectoryReading reading = read(std::string("t_s,lat_deg,lon_deg,h_m\n0.5,30.25,114,20\n1,30,114,20\n"));
  std::setlocale(LC_NUMERIC, "C");
  ASSERT_TRUE(reading.problems.empty()) << (german == nullptr ? "" : german);
  EXPECT_DOUBLE_EQ(reading.file.rows[0].position.latitude_rad, 30.25 * units::kDeg);
}

TEST_F(TrajectoryReader, ReadsWhatTheNavWriterWroteToItsResolution) {
  TrajectoryRow row;
  row.position = {-1.2345678901234567, 3.1415926535, 1234.5678901};
  row.v_n = nav::Vector3(-12.3456789, 0.0000004, 250.1234567);
  row.rpy = nav::RollPitchYaw{-3.1, 1.5, 6.28};
  {
    recordings::NavTextWriter writer(path("out.nav"));
    writer.write({2400, 604'799'999'999'999}, row);
    writer.write({2401, 4'999'999}, row);
    writer.close();
  }
  const TrajectoryReading reading = read_trajectory(path("out.nav"));
  ASSERT_TRUE(reading.problems.empty()) << reading.problems.kept().front().reason;
  EXPECT_EQ(reading.file.start, (time::GpsTime{2400, 604'799'999'999'999}));
  EXPECT_EQ(reading.file.rows[1].time.count(), 5'000'000);
  // Half a unit of the last decimal, and the rounding of the conversion between degrees and radians.
  const TrajectoryRow& back = reading.file.rows[0];
  const double position_rad = 0.5e-12 * units::kDeg + 1e-15;
  EXPECT_NEAR(back.position.latitude_rad, row.position.latitude_rad, position_rad);
  EXPECT_NEAR(back.position.longitude_rad, row.position.longitude_rad, position_rad);
  EXPECT_NEAR(back.position.height_m, row.position.height_m, 0.5e-6 + 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR((*back.v_n)[i], (*row.v_n)[i], 0.5e-6 + 1e-12);
  const double angle_rad = 0.5e-9 * units::kDeg + 1e-15;
  EXPECT_NEAR(back.rpy->roll_rad, row.rpy->roll_rad, angle_rad);
  EXPECT_NEAR(back.rpy->pitch_rad, row.rpy->pitch_rad, angle_rad);
  EXPECT_NEAR(back.rpy->yaw_rad, row.rpy->yaw_rad, angle_rad);
}

class TrajectoryOfALog : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    mcap::McapWriter log(path("run.mcap"));
    log::LogChannel<TruthState> truth(log, "inslab/truth");
    log::LogChannel<NavSolution> nav(log, "inslab/nav");
    for (std::uint64_t k = 0; k < 3; ++k) {
      TruthState state;
      state.header.sim_time_ns = static_cast<std::int64_t>(k) * 5'000'000;
      state.header.gps_week = 2400;
      state.header.gps_time_of_week_ns = 1'000'000'000 + state.header.sim_time_ns;
      state.latitude_rad = 0.5;
      state.v_n = Vector3(1.0, 2.0, 3.0);
      truth.write(state, 0, k, k);
      NavSolution solution;
      solution.gps_week = 2400;
      solution.gps_time_of_week_ns = state.header.gps_time_of_week_ns;
      solution.mode = k == 0 ? NavMode::Aligning : NavMode::Navigating;
      solution.latitude_rad = 0.5 + 0.1 * static_cast<double>(k);
      nav.write(solution, 0, k, k);
    }
    log.close();
  }
};

TEST_F(TrajectoryOfALog, IsItsTruth) {
  const TrajectoryReading reading = read_trajectory(path("run.mcap"));
  ASSERT_TRUE(reading.problems.empty());
  ASSERT_EQ(reading.file.rows.size(), 3U);
  EXPECT_EQ(reading.file.start, (time::GpsTime{2400, 1'000'000'000}));
  EXPECT_EQ(reading.file.rows[2].time.count(), 10'000'000);
  EXPECT_EQ(reading.file.rows[2].v_n.value(), nav::Vector3(1.0, 2.0, 3.0));
}

TEST_F(TrajectoryOfALog, OrTheSolutionWhileItNavigates) {
  TrajectoryReadOptions options;
  options.topic = "inslab/nav";
  const TrajectoryReading reading = read_trajectory(path("run.mcap"), options);
  ASSERT_TRUE(reading.problems.empty());
  ASSERT_EQ(reading.file.rows.size(), 2U);
  EXPECT_EQ(reading.file.rows[0].position.latitude_rad, 0.6);
}

TEST_F(TrajectoryOfALog, NamesTheTopicsWhenTheOneAskedForIsNotThere) {
  TrajectoryReadOptions options;
  options.topic = "inslab/imu/0";
  const TrajectoryReading reading = read_trajectory(path("run.mcap"), options);
  ASSERT_FALSE(reading.problems.empty());
  EXPECT_THAT(reading.problems.kept().front().reason, HasSubstr("inslab/truth (inslab::v5::TruthState)"));
}

}  // namespace trajectory_reader_test
}  // namespace inslab::trajectory
