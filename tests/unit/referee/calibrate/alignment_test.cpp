#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/referee/calibrate/recording.hpp"
#include "inslab/referee/verify/alignment_block.hpp"
#include "tests/unit/referee/verify/rows_held.hpp"

namespace inslab::calibrate {
namespace alignment_test {

constexpr double kLatitude_rad = 30.53 * units::kDeg;
constexpr double kDt_s = 0.005;

double gravity_m_per_s2() { return nav::Gravity().g_n(nav::Geodetic{kLatitude_rad, 0.0, 0.0}).norm(); }

nav::Vector3 dtheta(const nav::Matrix3& C_nb) { return C_nb.transpose() * nav::omega_ie_n(kLatitude_rad) * kDt_s; }
nav::Vector3 dv(const nav::Matrix3& C_nb) {
  return C_nb.transpose() * nav::Vector3(0.0, 0.0, -gravity_m_per_s2() * kDt_s);
}

/// A file of RAWIMUSXA lines of an ISA-100C at rest, gone with this object.
class RestingFile {
 public:
  explicit RestingFile(int samples) : path_(testing::TempDir() + "resting.asc") {
    novatel::NovatelImuFormatter format(26, novatel::NovatelAxes::RightForwardUp);
    std::ofstream file(path_);
    for (int k = 1; k <= samples; ++k) {
      const nav::Matrix3 C_nb = nav::Matrix3::Identity();
      lines_.push_back(format.line({2300, k * 5000000LL}, dtheta(C_nb), dv(C_nb)));
      file << lines_.back() << "\n";
    }
  }
  ~RestingFile() { std::filesystem::remove(path_); }
  RestingFile(const RestingFile&) = delete;
  RestingFile& operator=(const RestingFile&) = delete;

  /// One more line, of another IMU.
  void add_line_of_type(std::uint32_t imu_type) {
    novatel::NovatelImuFormatter format(imu_type, novatel::NovatelAxes::RightForwardUp);
    const auto next = static_cast<std::int64_t>(lines_.size()) + 1;
    lines_.push_back(
        format.line({2300, next * 5000000LL}, dtheta(nav::Matrix3::Identity()), dv(nav::Matrix3::Identity())));
    std::ofstream(path_, std::ios::app) << lines_.back() << "\n";
  }
  void damage_last() {
    lines_.back()[lines_.back().size() - 1] = lines_.back().back() == '0' ? '1' : '0';
    std::ofstream file(path_);
    for (const std::string& line : lines_) file << line << "\n";
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::vector<std::string> lines_;
};

RecordingOptions at_site() {
  RecordingOptions options;
  options.latitude_deg = 30.53;
  return options;
}

TEST(VerifyAlignment, TheLabsTableComesOutOfItsNoise) {
  for (const verify::Table& table : verify::alignment_tables(1)) EXPECT_TRUE(verify::every_row_held(table));
}

TEST(StaticAlignment, YawAroundNorthHasAMeanAndASpread) {
  StaticAlignment alignment(kDt_s, kLatitude_rad, gravity_m_per_s2(), {});
  for (int k = 0; k < 400; ++k) {
    const nav::Matrix3 C_nb = nav::matrix_from_rpy({0.0, 0.0, (k % 2 == 0 ? 1.0 : -1.0) * units::kDeg});
    alignment.add(dtheta(C_nb), dv(C_nb));
  }
  const AlignmentResult result = alignment.result();
  // +-1 deg, 200 times each: 1 deg times sqrt(400/399).
  EXPECT_NEAR(result.epochs.sigma_rad.z(), units::kDeg * std::sqrt(400.0 / 399.0), 1e-9);
  EXPECT_NEAR(nav::wrapped_to_pi(result.epochs.mean_rad.z()), 0.0, 1e-9);
  EXPECT_EQ(result.each_second.size(), 2U);
}

TEST(StaticAlignment, RefusesLessThanASecond) {
  StaticAlignment alignment(kDt_s, kLatitude_rad, gravity_m_per_s2(), {});
  alignment.add(dtheta(nav::Matrix3::Identity()), dv(nav::Matrix3::Identity()));
  EXPECT_FALSE(alignment.result().whole);
  EXPECT_EQ(alignment.result().refusal, "the recording is shorter than a second");
}

TEST(AlignRecording, LeavesADamagedLineOutAndNamesIt) {
  RestingFile file(400);
  file.damage_last();
  const AlignedRecording aligned = align_recording(file.path(), at_site());
  EXPECT_EQ(aligned.alignment.samples, 399U);
  ASSERT_EQ(aligned.bad_lines.size(), 1U);
  EXPECT_EQ(aligned.bad_lines.front().line, 400U);
  EXPECT_TRUE(aligned.alignment.whole);
}

// Counts of one type read with the factors of another would be an attitude like any other.
TEST(AlignRecording, RefusesSamplesOfTwoImuTypesNamingTheLine) {
  RestingFile file(400);
  file.add_line_of_type(16);
  EXPECT_THAT([&] { align_recording(file.path(), at_site()); },
              testing::ThrowsMessage<files::ReadError>(
                  testing::HasSubstr("resting.asc: line 401 is of IMU type 16; expected 26, as the lines before it")));
}

TEST(AlignRecording, RefusesAFileWithoutAGoodSample) {
  RestingFile file(1);
  file.damage_last();
  EXPECT_THAT([&] { align_recording(file.path(), at_site()); },
              testing::ThrowsMessage<files::ReadError>(testing::HasSubstr("no line is a good IMU sample")));
}

}  // namespace alignment_test
}  // namespace inslab::calibrate
