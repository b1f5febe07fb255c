#include "inslab/formats/recordings/imu_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::recordings {
namespace imu_recording_test {

class ImuRecording : public test::TemporaryFolder {
 protected:
  /// Reads `text` as a file named imu.txt.
  std::vector<ImuIncrements> read(const std::string& text, const ImuRecordingOptions& options = {}) {
    put(path("imu.txt"), text);
    std::vector<ImuIncrements> all;
    info_ = read_imu_recording(
        path("imu.txt"), options, [](const ImuRecordingInfo&) {},
        [&](const ImuIncrements& increments) { all.push_back(increments); });
    return all;
  }

  std::string error_of(const std::string& text, const ImuRecordingOptions& options = {}) {
    try {
      read(text, options);
    } catch (const files::ReadError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  ImuRecordingInfo info_;
};

TEST_F(ImuRecording, SevenColumnsAreSecondsAndIncrements) {
  const auto samples = read(
      "% a comment\n"
      "100.00 1e-3 2e-3 3e-3 0.1 0.2 0.3\n"
      "100.01 1e-3 2e-3 3e-3 0.1 0.2 0.3\n"
      "100.02 4e-3 2e-3 3e-3 0.1 0.2 9.8\n");
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[2], (ImuIncrements{4e-3, 2e-3, 3e-3, 0.1, 0.2, 9.8}));
  EXPECT_NEAR(info_.dt_s, 0.01, 1e-12);
  EXPECT_EQ(info_.gaps, 0u);
}

TEST_F(ImuRecording, NamesGiveTheAxesAndRatesBecomeIncrements) {
  const auto samples = read(
      "temperature_deg_c, time_ms, gyro_z_deg_per_s, accel_x_g\n"
      "20, 0, 2, 1\n20, 20, 2, 1\n20, 40, 3, 1\n");
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_NEAR(samples[2][2], 3.0 * units::kDeg * 0.02, 1e-15);
  EXPECT_NEAR(samples[2][3], 9.80665 * 0.02, 1e-12);
  EXPECT_THAT(info_.has_axis, ::testing::ElementsAre(false, false, true, true, false, false));
}

TEST_F(ImuRecording, TheNamesOfOurOwnExportAreKnown) {
  const auto samples =
      read("header.sim_time_ns,dtheta_b_rad.y,dv_b_m_per_s.z\n5000000,0.5,1.5\n10000000,0.5,1.5\n15000000,0.5,1.5\n");
  EXPECT_EQ(samples[0], (ImuIncrements{0.0, 0.5, 0.0, 0.0, 0.0, 1.5}));
  EXPECT_NEAR(info_.dt_s, 0.005, 1e-15);
}

TEST_F(ImuRecording, APeriodThatIsNoWholeNumberOfNanosecondsIsNotRoundedToOne) {
  std::ostringstream text;
  text << "time_ns,gyro_x_rad_per_s\n";
  for (std::int64_t k = 1; k <= 1200; ++k) text << (2 * k * 1'000'000'000 + 300) / 600 << ",3\n";  // 300 Hz, nearest ns
  const auto samples = read(text.str());
  EXPECT_NEAR(info_.dt_s, 1.0 / 300.0, 2e-12);  // one nanosecond over 999 intervals; rounded it errs by 3e-10
  EXPECT_NEAR(samples[0][0], 0.01, 1e-11);
}

TEST_F(ImuRecording, AMissingSampleIsRefusedByItsLineUnlessGapsArePassedOver) {
  const std::string text = "time_s,gyro_x_rad_per_s\n0,1\n1,1\n2,1\n4,1\n5,1\n";
  EXPECT_THAT(error_of(text), ::testing::HasSubstr("imu.txt: line 5: comes 2.000000 s after the one before"));
  ImuRecordingOptions options;
  options.over_gaps = true;
  EXPECT_EQ(read(text, options).size(), 5u);
  EXPECT_EQ(info_.gaps, 1u);
}

TEST_F(ImuRecording, WhatIsWrongIsNamedWithItsPlace) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error_of("time_s,gyro_x_rad_per_s\n0,1\n1,nan\n2,1\n"), HasSubstr("line 3, column 2: is 'nan'"));
  EXPECT_THAT(error_of("time_s,gyro_x_rad_per_s\n0,1\n1\n"), HasSubstr("line 3: has 1 columns; expected 2"));
  EXPECT_THAT(error_of("time_s,gyro_x_rad_per_s\n0,1\n0,1\n0,1\n"), HasSubstr("times do not increase"));
  EXPECT_THAT(error_of("time_s,gyro_x_rad_per_s\n0,1\n1,1\n"), HasSubstr("has 2 samples of an IMU"));
  EXPECT_THAT(error_of("time_s,gyro_x_deg_per_s,gyro_x_rad_per_s\n"), HasSubstr("'gyro_x_rad_per_s' gives again"));
  EXPECT_THAT(error_of("t,wx,wy\n0,1,2\n"), HasSubstr("line 1: expected 7 numbers, or names"));
  EXPECT_THAT(error_of("1 2 3\n"), HasSubstr("has 3 columns without names; expected 7"));
  EXPECT_THAT(error_of("# nothing\n"), HasSubstr("is empty"));
}

TEST_F(ImuRecording, OnlyALogHasATruthToTakeOff) {
  ImuRecordingOptions options;
  options.minus_truth = true;
  EXPECT_THAT(error_of("time_s,gyro_x_rad_per_s\n0,1\n1,1\n2,1\n", options), ::testing::HasSubstr("is no log of ours"));
}

}  // namespace imu_recording_test
}  // namespace inslab::recordings
