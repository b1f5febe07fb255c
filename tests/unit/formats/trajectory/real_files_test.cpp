// Files as other programs and users write them: times, names and sigmas that were taken for something else.

#include <gmock/gmock.h>

#include "inslab/formats/recordings/gnss_text.hpp"
#include "inslab/formats/recordings/imu_recording.hpp"
#include "inslab/formats/recordings/imu_text.hpp"
#include "inslab/formats/trajectory/trajectory_judge.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"
#include "inslab/foundation/files/calendar_time.hpp"
#include "inslab/foundation/files/decimal_time.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::trajectory {
namespace real_files_test {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(DecimalTime, IsExactWhereADoubleIsNot) {
  constexpr std::int64_t kS = 1'000'000'000;
  EXPECT_EQ(files::exact_nanoseconds("1700000000.01", kS), 1'700'000'000'010'000'000);
  EXPECT_EQ(files::exact_nanoseconds("1700000000005000000", 1), 1'700'000'000'005'000'000);
  EXPECT_EQ(files::exact_nanoseconds("-0.5", kS), -500'000'000);
  EXPECT_EQ(files::exact_nanoseconds("+12.3456789", 1'000'000), 12'345'679) << "rounded once";
  EXPECT_EQ(files::exact_nanoseconds(".25", 1000), 250);
  EXPECT_EQ(files::exact_nanoseconds("1e3", kS), 1000 * kS);
  EXPECT_EQ(files::exact_nanoseconds("1.700000000010000000e+09", kS), 1'700'000'000'010'000'000) << "as NumPy writes";
  EXPECT_EQ(files::exact_nanoseconds("1.70000000000500000000E18", 1), 1'700'000'000'005'000'000);
  EXPECT_EQ(files::exact_nanoseconds("-2.5e-01", kS), -250'000'000);
  EXPECT_EQ(files::exact_nanoseconds("12e-4", kS), 1'200'000);
  EXPECT_EQ(files::exact_nanoseconds("0.00125e2", kS), 125'000'000);
  for (const char* wrong : {"", "-", ".", "12:00", "9999999999999999999", "1e30", "nan", "0x10", "e5", ".e1", "1e",
                            "1e+", "1e5.0", "1.2.3e4", "1e99999"}) {
    EXPECT_EQ(files::exact_nanoseconds(wrong, kS), std::nullopt) << wrong;
  }
}

TEST(CalendarTime, IsGpsTime) {
  // 2024-03-05 was a Tuesday of GPS week 2304: 2 days and 10 hours, 208800 s.
  const auto time = files::gps_from_calendar("2024/03/05", "10:00:01.250");
  ASSERT_TRUE(time);
  EXPECT_EQ(time->week, 2304u);
  EXPECT_EQ(time->time_of_week_ns, 208'801'250'000'000);
  EXPECT_EQ(files::gps_from_calendar("1980-01-06", "00:00:00")->time_of_week_ns, 0);
  EXPECT_EQ(files::gps_from_calendar("2000/02/29", "00:00:00")->week, 1051u);
  for (const char* date : {"1979/12/31", "2024/13/05", "2024.03.05", "24/03/05"}) {
    EXPECT_FALSE(files::gps_from_calendar(date, "10:00:00")) << date;
  }
  EXPECT_FALSE(files::gps_from_calendar("2024/03/05", "25:00:00"));
}

class RealFiles : public test::TemporaryFolder {
 protected:
  std::string file(const std::string& text) {
    put(path("file.txt"), text);
    return path("file.txt");
  }
  static std::string row(const std::string& time, int k) {
    return time + ",45,11." + std::to_string(1000000 + k).substr(1) + ",100\n";
  }
};

TEST_F(RealFiles, UnixTimesAreReadAsTheSameRowsFromZero) {
  std::string unix_time = "t_s,lat_deg,lon_deg,h_m\n", nanoseconds = "timestamp_ns,lat_deg,lon_deg,h_m\n",
              zero = unix_time;
  for (int k = 0; k < 50; ++k) {
    const std::string fraction = std::to_string(100 + k).substr(1);
    unix_time += row("1700000000." + fraction, k);
    nanoseconds += row("1700000000" + fraction + "0000000", k);
    zero += row("0." + fraction, k);
  }
  const TrajectoryReading from_zero = read_trajectory(file(zero), {});
  ASSERT_TRUE(from_zero.problems.empty());
  for (const std::string& text : {unix_time, nanoseconds}) {
    const TrajectoryReading reading = read_trajectory(file(text), {});
    ASSERT_TRUE(reading.problems.empty()) << reading.problems.kept().front().reason;
    ASSERT_EQ(reading.file.rows.size(), 50u);
    for (std::size_t k = 0; k < 50; ++k) {
      EXPECT_EQ(reading.file.rows[k].time, from_zero.file.rows[k].time);
      EXPECT_EQ(reading.file.rows[k].position.longitude_rad, from_zero.file.rows[k].position.longitude_rad);
    }
    EXPECT_EQ(reading.file.start.week, 2288u) << "2023-11-14";
  }
}

constexpr const char* kRtklibHead =
    "% program   : rnx2rtkp\n"
    "%  GPST                  latitude(deg) longitude(deg)  height(m)   Q  ns   sdn(m)   sde(m)   sdu(m)  sdne(m)  "
    "sdeu(m)  sdun(m) age(s)  ratio\n";

TEST_F(RealFiles, SolutionsOfRtklibAreReadInBothTimeFormats) {
  constexpr const char* kRest = "   430.0000   1  12   0.01   0.01   0.02   0.001   0.001   0.001   0.00    9.9\n";
  std::string dated = kRtklibHead, weeks = kRtklibHead;
  for (int k = 0; k < 10; ++k) {
    const std::string position = "   47.00007" + std::to_string(k) + "    9.000000000" + kRest;
    dated += "2024/03/05 10:00:0" + std::to_string(k) + ".000" + position;
    weeks += "2304 20880" + std::to_string(k) + ".000" + position;
  }
  for (const std::string& text : {dated, weeks}) {
    const TrajectoryReading reading = read_trajectory(file(text), {});
    ASSERT_TRUE(reading.problems.empty()) << reading.problems.kept().front().reason;
    ASSERT_EQ(reading.file.rows.size(), 10u);
    EXPECT_EQ(reading.file.rows.back().time, std::chrono::seconds(9));
    EXPECT_EQ(reading.file.start.week, 2304u);
    EXPECT_EQ(reading.file.start.time_of_week_ns, 208'800'000'000'000);
    EXPECT_DOUBLE_EQ(reading.file.rows[0].position.height_m, 430.0);
  }
}

TEST_F(RealFiles, ColumnsAreLeftAsideByNameOrByADash) {
  const std::string rows = "1,47,9,430,5,7.5,0.1\n2,47.00001,9,430,5,7.5,0.1\n";
  EXPECT_TRUE(read_trajectory(file("t_s,lat_deg,lon_deg,h_m,q,-,sd_n_m\n" + rows), {}).problems.empty());
  TrajectoryReadOptions options;
  options.columns = "t_s,lat_deg,lon_deg,h_m,-,-,-";
  EXPECT_TRUE(read_trajectory(file(rows), options).problems.empty());
  const TrajectoryReading named = read_trajectory(file("t_s,lat_deg,lon_deg,h_m,mood\n1,47,9,430,5\n"), {});
  EXPECT_THAT(named.problems.kept().front().reason, HasSubstr("column 5 is 'mood'"));
  EXPECT_THAT(named.problems.kept().front().reason, HasSubstr("'-' to leave the column aside"));
  const TrajectoryReading comment = read_trajectory(file("# t_s lat_deg lon_deg h_m mood\n1 47 9 430 5\n"), {});
  EXPECT_THAT(comment.problems.kept().front().reason, HasSubstr("of the names above it 'mood' is not understood"));
}

TEST_F(RealFiles, SecondsOfWeekGoOnPastTheEndOfTheWeek) {
  recordings::ImuTextReader reader(
      file("604798 0 0 0 0 0 -9.8\n604799 0 0 0 0 0 -9.8\n0 0 0 0 0 0 -9.8\n1 0 0 0 0 0 -9.8\n"));
  recordings::ImuTextRecord record;
  std::vector<double> seconds;
  while (reader.next(record)) seconds.push_back(time::to_seconds(record.in_week));
  EXPECT_THAT(seconds, testing::ElementsAre(604798.0, 604799.0, 604800.0, 604801.0));
  recordings::ImuTextReader back(file("100 0 0 0 0 0 -9.8\n99 0 0 0 0 0 -9.8\n"));
  ASSERT_TRUE(back.next(record));
  EXPECT_THAT([&] { back.next(record); }, ThrowsMessage<files::ReadError>(HasSubstr("expected time to go on")));
  {
    recordings::ImuTextWriter writer(path("out.txt"));
    writer.write({time::from_seconds(604801.0), nav::Vector3::Zero(), nav::Vector3::Zero()});
    writer.close();
  }
  EXPECT_THAT(contents(path("out.txt")), testing::StartsWith("1.000000000 "));
}

TEST_F(RealFiles, AFixWithoutASigmaIsRefusedWithItsPlace) {
  recordings::GnssTextReader reader(file("100 47 9 430 0.03 0.03 0.05\n101 47 9 430 0 0 0\n"));
  recordings::GnssTextRecord record;
  ASSERT_TRUE(reader.next(record));
  EXPECT_THAT([&] { reader.next(record); },
              ThrowsMessage<files::ReadError>(testing::AllOf(HasSubstr("file.txt: line 2, column 5: is 0"),
                                                             HasSubstr("columns 5 to 7"), HasSubstr("above 0 m"))));
}

class ImuFiles : public RealFiles {
 protected:
  recordings::ImuRecordingInfo read(const std::string& text) {
    sums_ = {};
    recordings::ImuRecordingInfo info = recordings::read_imu_recording(
        file(text), {}, [](const recordings::ImuRecordingInfo&) {},
        [this](const recordings::ImuIncrements& sample) {
          for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += sample[i];
        });
    return info;
  }
  recordings::ImuIncrements sums_{};
};

TEST_F(ImuFiles, NamesInACommentWithUnitsInBracketsAreRead) {
  std::string text =
      "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],"
      "a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n";
  for (int k = 0; k < 400; ++k) {
    text += std::to_string(1'700'000'000'000'000'000 + 5'000'000LL * k) + ",0.01,0,0,0,0,-9.81\n";
  }
  const recordings::ImuRecordingInfo info = read(text);
  EXPECT_DOUBLE_EQ(info.dt_s, 0.005);
  EXPECT_EQ(info.samples, 400u);
  EXPECT_NEAR(sums_[0], 0.01 * 2.0, 1e-12) << "rates became increments";
  EXPECT_NEAR(sums_[5], -9.81 * 2.0, 1e-9);
}

TEST_F(ImuFiles, SevenColumnsWithoutNamesAreRefusedWhereTheyCannotBeSecondsOrIncrements) {
  std::string nanoseconds, milliseconds, rates;
  for (int k = 0; k < 40; ++k) {
    nanoseconds += std::to_string(1'700'000'000'000'000'000 + 5'000'000LL * k) + " 0 0 0 0 0 -0.05\n";
    milliseconds += std::to_string(20 * k) + " 0 0 0 0 0 -0.2\n";
    rates += std::to_string(0.005 * k) + " 0 0 0 0 0 -9.81\n";
  }
  EXPECT_THAT([&] { read(nanoseconds); },
              ThrowsMessage<files::ReadError>(
                  HasSubstr("expected a time in seconds; milli-, micro- and nanoseconds need a name")));
  EXPECT_THAT([&] { read(milliseconds); },
              ThrowsMessage<files::ReadError>(testing::AllOf(HasSubstr("which no IMU has"), HasSubstr("time_ns"))));
  EXPECT_THAT([&] { read(rates); }, ThrowsMessage<files::ReadError>(
                                        testing::AllOf(HasSubstr("gravity as a rate"), HasSubstr("name the columns"))));
}

}  // namespace real_files_test
}  // namespace inslab::trajectory
