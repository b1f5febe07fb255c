#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "inslab/formats/exports/log_file_export.hpp"
#include "inslab/formats/log/log_channel.hpp"
#include "inslab/formats/recordings/gnss_text.hpp"
#include "inslab/formats/recordings/imu_text.hpp"
#include "inslab/formats/recordings/kml.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::recordings {
namespace text_formats_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "no error";
}

/// A run of two IMUs, one receiver and the truth, with values of all sizes.
class FileExport : public test::TemporaryFolder {
 protected:
  static constexpr std::uint64_t kSamples = 50;

  void SetUp() override {
    TemporaryFolder::SetUp();
    mcap::McapWriter log(path("run.mcap"));
    log::LogChannel<TruthState> truth(log, "inslab/truth");
    log::LogChannel<ImuSample> imu(log, "inslab/imu/0");
    log::LogChannel<ImuSample> other_imu(log, "inslab/imu/1");
    log::LogChannel<GnssFix> gnss(log, "inslab/gnss/0");
    for (std::uint64_t k = 0; k < kSamples; ++k) {
      const double phase = 0.7 * static_cast<double>(k);
      truths_.push_back(make_truth(k, phase));
      truth.write(truths_.back(), 0, k, k);
      imus_.push_back(make_imu(k, phase));
      imu.write(imus_.back(), 0, k, k);
      other_imu.write(imus_.back(), 0, k, k);
      fixes_.push_back(make_fix(k, phase));
      gnss.write(fixes_.back(), 0, k, k);
    }
    log.close();
  }

  exports::ExportedFile exported(exports::FileFormat format, const std::string& name, const std::string& topic = "") {
    exports::FileExportOptions options;
    options.format = format;
    options.destination = path(name);
    options.topic = topic;
    return exports::export_file(path("run.mcap"), options);
  }

  static StreamHeader header(std::uint64_t k) {
    StreamHeader header;
    header.sim_time_ns = static_cast<std::int64_t>(k) * 5'000'000;
    header.gps_week = 2400;
    header.gps_time_of_week_ns = 123'456'789'000'000 + header.sim_time_ns;
    return header;
  }
  static TruthState make_truth(std::uint64_t k, double phase) {
    TruthState truth;
    truth.header = header(k);
    truth.latitude_rad = -0.5 + 1e-7 * phase;
    truth.longitude_rad = -2.1 + 1e-7 * phase;
    truth.height_m = 20.123456789 + phase;
    truth.v_n = Vector3(std::sin(phase), 200.0 * std::cos(phase), 1e-5 * phase);
    truth.q_nv = nav::quaternion_from_rpy({std::sin(phase), 0.3 * std::cos(phase), phase});
    return truth;
  }
  static ImuSample make_imu(std::uint64_t k, double phase) {
    ImuSample sample;
    sample.header = header(k);
    sample.interval_ns = k == 0 ? 0 : 5'000'000;
    sample.dtheta_b = 1e-3 * Vector3(std::sin(phase), std::cos(phase), 1e-6);
    sample.dv_b = Vector3(1e-7, 0.01 * std::sin(phase), -0.049);
    return sample;
  }
  static GnssFix make_fix(std::uint64_t k, double phase) {
    GnssFix fix;
    fix.header = header(k);
    fix.fix_type = k == 7 ? FixType::None : FixType::Fixed;
    fix.latitude_rad = 0.5 + 1e-7 * phase;
    fix.longitude_rad = 2.0 - 1e-7 * phase;
    fix.height_m = -12.3456789;
    fix.position_sigma_ned_m = Vector3(0.01, 0.02, 0.031);
    return fix;
  }

  std::vector<TruthState> truths_;
  std::vector<ImuSample> imus_;
  std::vector<GnssFix> fixes_;
};

TEST_F(FileExport, NavTextReadsBackToTheTruthItWasMadeOf) {
  EXPECT_EQ(exported(exports::FileFormat::Nav, "run.nav").rows, kSamples);
  const trajectory::TrajectoryReading reading = trajectory::read_trajectory(path("run.nav"));
  ASSERT_TRUE(reading.problems.empty());
  ASSERT_EQ(reading.file.rows.size(), kSamples);
  for (std::size_t k = 0; k < kSamples; ++k) {
    const TrajectoryRow& row = reading.file.rows[k];
    EXPECT_EQ(row.time.count(), truths_[k].header.sim_time_ns);
    // Half of the last decimal: 12 of degrees, 6 of metres, 9 of degrees for each of three angles.
    EXPECT_NEAR(row.position.latitude_rad, truths_[k].latitude_rad, 0.5e-12 * units::kDeg + 1e-15);
    EXPECT_NEAR(row.position.longitude_rad, truths_[k].longitude_rad, 0.5e-12 * units::kDeg + 1e-15);
    EXPECT_NEAR(row.position.height_m, truths_[k].height_m, 0.5e-6 + 1e-12);
    EXPECT_LE((*row.v_n - truths_[k].v_n).cwiseAbs().maxCoeff(), 0.5e-6 + 1e-12);
    EXPECT_LE(nav::angle_between(nav::quaternion_from_rpy(*row.rpy), truths_[k].q_nv),
              3 * 0.5e-9 * units::kDeg + 1e-15);
  }
}

TEST_F(FileExport, ImuTextReadsBackWithoutTheSampleThatHasNoInterval) {
  const exports::ExportedFile file = exported(exports::FileFormat::Imu, "imu.txt", "inslab/imu/0");
  EXPECT_EQ(file.rows, kSamples - 1);
  EXPECT_EQ(file.left_out, 1U);
  ImuTextReader reader(path("imu.txt"));
  ImuTextRecord record;
  for (std::size_t k = 1; k < kSamples; ++k) {
    ASSERT_TRUE(reader.next(record));
    EXPECT_EQ(record.in_week.count(), imus_[k].header.gps_time_of_week_ns);
    EXPECT_LE((record.dtheta_b - imus_[k].dtheta_b).cwiseAbs().maxCoeff(), 0.5e-15 + 1e-18);
    EXPECT_LE((record.dv_b - imus_[k].dv_b).cwiseAbs().maxCoeff(), 0.5e-12 + 1e-15);
  }
  EXPECT_FALSE(reader.next(record));
}

TEST_F(FileExport, GnssTextReadsBackWithoutTheEpochThatHasNoFix) {
  const exports::ExportedFile file = exported(exports::FileFormat::Gnss, "gnss.txt");
  EXPECT_EQ(file.topic, "inslab/gnss/0");
  EXPECT_EQ(file.rows, kSamples - 1);
  GnssTextReader reader(path("gnss.txt"));
  GnssTextRecord record;
  for (std::size_t k = 0; k < kSamples; ++k) {
    if (k == 7) continue;
    ASSERT_TRUE(reader.next(record));
    EXPECT_EQ(record.in_week.count(), fixes_[k].header.gps_time_of_week_ns);
    EXPECT_NEAR(record.position.latitude_rad, fixes_[k].latitude_rad, 0.5e-12 * units::kDeg + 1e-15);
    EXPECT_NEAR(record.position.longitude_rad, fixes_[k].longitude_rad, 0.5e-12 * units::kDeg + 1e-15);
    EXPECT_NEAR(record.position.height_m, fixes_[k].height_m, 0.5e-6 + 1e-12);
    EXPECT_LE((record.sigma_ned_m - fixes_[k].position_sigma_ned_m).cwiseAbs().maxCoeff(), 0.5e-6);
  }
  EXPECT_FALSE(reader.next(record));
  // The trajectory reader takes the same file.
  EXPECT_EQ(trajectory::read_trajectory(path("gnss.txt")).file.rows.size(), kSamples - 1);
}

TEST_F(FileExport, NovatelLinesReadBackToHalfACountAndLoseNothingInSum) {
  EXPECT_EQ(exported(exports::FileFormat::Novatel, "raw.txt", "inslab/imu/0").rows, kSamples - 1);
  const novatel::NovatelImuType& type = *novatel::find_novatel_imu_type(exports::FileExportOptions{}.novatel_imu_type);
  novatel::NovatelImuReader reader(path("raw.txt"));
  novatel::NovatelImuRecord record;
  Vector3 lost_rad = Vector3::Zero();
  Vector3 lost_m_per_s = Vector3::Zero();
  for (std::size_t k = 1; k < kSamples; ++k) {
    ASSERT_TRUE(reader.next(record)) << reader.bad_lines().front().reason;
    EXPECT_EQ(record.time, (time::GpsTime{2400, imus_[k].header.gps_time_of_week_ns}));
    // A count is the rounded sum of the increment and at most half a count carried.
    EXPECT_LE((record.dtheta_b - imus_[k].dtheta_b).cwiseAbs().maxCoeff(), 1.001 * type.rad_per_count);
    EXPECT_LE((record.dv_b - imus_[k].dv_b).cwiseAbs().maxCoeff(), 1.001 * type.m_per_s_per_count);
    lost_rad += imus_[k].dtheta_b - record.dtheta_b;
    lost_m_per_s += imus_[k].dv_b - record.dv_b;
    EXPECT_LE(lost_rad.cwiseAbs().maxCoeff(), 0.501 * type.rad_per_count);
    EXPECT_LE(lost_m_per_s.cwiseAbs().maxCoeff(), 0.501 * type.m_per_s_per_count);
  }
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.bad_line_count(), 0U);
}

TEST_F(FileExport, AsksWhichImuWhenThereAreTwoAndSaysWhatALogHas) {
  EXPECT_THAT(message_of([&] { exported(exports::FileFormat::Imu, "imu.txt"); }),
              HasSubstr("has inslab/imu/0 and inslab/imu/1; expected to be told which"));
  EXPECT_THAT(message_of([&] { exported(exports::FileFormat::Nav, "nav.nav", "inslab/imu/0"); }),
              HasSubstr("has no topic inslab/imu/0 of the type inslab::v5::TruthState; it has "));
}

TEST_F(FileExport, DrawsATrackWithItsEnds) {
  EXPECT_EQ(exported(exports::FileFormat::Kml, "run.kml").rows, kSamples);
  const std::string kml = contents(path("run.kml"));
  EXPECT_THAT(kml, StartsWith("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml "));
  EXPECT_THAT(kml, HasSubstr("<name>run.mcap: inslab/truth</name>"));
  EXPECT_THAT(kml, HasSubstr("\n-120.321136977,-28.647889757,20.123\n"));
  EXPECT_THAT(kml, HasSubstr("<altitudeMode>clampToGround</altitudeMode>"));
}

TEST(KmlTrack, KeepsTheEndsAndABoundedNumberOfPointsOfALongRun) {
  KmlTrack track;
  for (int i = 0; i <= 100'001; ++i) track.add({1e-6 * i, 0.0, 0.0});
  EXPECT_LT(track.size(), KmlTrack::kMaxPoints);
  EXPECT_GT(track.size(), KmlTrack::kMaxPoints / 2);
}

TEST_F(FileExport, EscapesWhatXmlCannotHold) {
  KmlTrack track;
  track.add({});
  track.write(path("a.kml"), "<a & b>\x01");
  EXPECT_THAT(contents(path("a.kml")), HasSubstr("<name>&lt;a &amp; b&gt;\\x01</name>"));
}

TEST_F(FileExport, ReadersNameLineAndColumnOfWhatTheyRefuse) {
  ImuTextRecord imu;
  put(path("imu.txt"), "# comment\n1 2 3 4 5 6 7\n1 2 x 4 5 6 7\n");
  EXPECT_THAT(message_of([&] {
                ImuTextReader reader(path("imu.txt"));
                while (reader.next(imu)) {
                }
              }),
              HasSubstr("imu.txt: line 3, column 3: is 'x'; expected a finite number"));
  put(path("imu.txt"), "1 2 3 4 5 6\n");
  EXPECT_THAT(message_of([&] { ImuTextReader(path("imu.txt")).next(imu); }),
              HasSubstr("line 1: has 6 fields; expected 7"));
  GnssTextRecord gnss;
  put(path("gnss.txt"), "1 95 3 4 5 6 7\n");
  EXPECT_THAT(message_of([&] { GnssTextReader(path("gnss.txt")).next(gnss); }), HasSubstr("gnss.txt: line 1: "));
  put(path("gnss.txt"), "-1 30 3 4 5 6 7\n");
  EXPECT_THAT(message_of([&] { GnssTextReader(path("gnss.txt")).next(gnss); }),
              HasSubstr("line 1, column 1: is -1.000000; expected seconds of week from 0 to 604800"));
}

}  // namespace text_formats_test
}  // namespace inslab::recordings
