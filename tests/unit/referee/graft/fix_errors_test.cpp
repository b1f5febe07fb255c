#include "inslab/referee/graft/fix_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "inslab/formats/recordings/fix_errors_text.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/stream.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

/// Errors that were put into fixes come out again.
namespace inslab::graft {
namespace fix_errors_test {

class FixErrorsOfAFile : public test::TemporaryFolder {
 protected:
  /// A vehicle that turns; rows at 20 Hz of 60 s, week 2399, second 1000 on.
  void SetUp() override {
    test::TemporaryFolder::SetUp();
    std::ofstream reference(path("truth.nav")), fixes(path("fixes.txt"));
    const random::Stream north(3, "north"), east(3, "east"), down(3, "down");
    char line[256];
    for (int k = 0; k <= 1200; ++k) {
      const double t = 0.05 * k;
      std::snprintf(line, sizeof(line), "2399 %.9f %.12f %.12f %.6f %.6f %.6f %.6f %.9f %.9f %.9f\n", 1000.0 + t,
                    latitude_deg(t), longitude_deg(t), 50.0, north_m_per_s(t), east_m_per_s(t), 0.0, 0.0, 0.0,
                    yaw_deg(t));
      reference << line;
    }
    for (int k = 1; k < 60; ++k) {
      if (k > 30 && k < 40) continue;
      const double t = k;
      // The antenna 2 m ahead and 1 m to the right; the receiver's clock 20 ms behind the reference's.
      const double yaw = yaw_deg(t) * units::kDeg;
      const double n = 2.0 * std::cos(yaw) - 1.0 * std::sin(yaw), e = 2.0 * std::sin(yaw) + 1.0 * std::cos(yaw);
      const auto index = static_cast<std::uint64_t>(k);
      std::snprintf(line, sizeof(line), "%.9f %.12f %.12f %.6f 0.01 0.01 0.02\n", 1000.0 + t - 0.02,
                    latitude_deg(t) + (n + 0.01 * north.normal(index)) / kNorthM,
                    longitude_deg(t) + (e + 0.01 * east.normal(index)) / kEastM, 50.0 - 0.02 * down.normal(index));
      fixes << line;
    }
  }

  // Metres of a degree at 45 deg north and 50 m up, by the radii of curvature of WGS 84.
  static constexpr double kNorthM = 111132.65007880167;
  static constexpr double kEastM = 78847.45216105282;

  // Turning at 0.1 rad/s with a speed of 10 + 5 sin(0.3 t) m/s, or the arm ahead and the offset would be one.
  static double north_m(double t) {
    return 100.0 * std::sin(0.1 * t) + 2.5 * ((1.0 - std::cos(0.4 * t)) / 0.4 + (1.0 - std::cos(0.2 * t)) / 0.2);
  }
  static double east_m(double t) {
    return 100.0 * (1.0 - std::cos(0.1 * t)) + 2.5 * (std::sin(0.2 * t) / 0.2 - std::sin(0.4 * t) / 0.4);
  }
  static double speed_m_per_s(double t) { return 10.0 + 5.0 * std::sin(0.3 * t); }
  static double latitude_deg(double t) { return 45.0 + north_m(t) / kNorthM; }
  static double longitude_deg(double t) { return 7.0 + east_m(t) / kEastM; }
  static double north_m_per_s(double t) { return speed_m_per_s(t) * std::cos(0.1 * t); }
  static double east_m_per_s(double t) { return speed_m_per_s(t) * std::sin(0.1 * t); }
  static double yaw_deg(double t) {
    const double deg = 0.1 * t / units::kDeg;
    return deg > 180.0 ? deg - 360.0 : deg;
  }

  FixErrorOptions options() const {
    FixErrorOptions options;
    options.file = path("fixes.txt");
    options.reference = path("truth.nav");
    options.fix_type = FixType::Fixed;
    return options;
  }
};

TEST_F(FixErrorsOfAFile, FindTheArmAndTheOffsetAndLeaveTheNoise) {
  const FixErrors found = extract_fix_errors(options());
  ASSERT_EQ(found.errors.epochs.size(), 50u);
  EXPECT_EQ(found.errors.interval, time::from_seconds(1.0));
  Vector3 squares = Vector3::Zero();
  for (const auto& epoch : found.errors.epochs) squares += epoch.position_ned_m.cwiseAbs2() / 50.0;
  // 1 cm, 1 cm and 2 cm, of which arm and offset took some; 4 standard errors of 50 values.
  EXPECT_NEAR(std::sqrt(squares.x()), 0.01, 0.004);
  EXPECT_NEAR(std::sqrt(squares.y()), 0.01, 0.004);
  EXPECT_NEAR(std::sqrt(squares.z()), 0.02, 0.008);
  const std::string::size_type offset = found.text.find("time offset ");
  const std::string::size_type arm = found.text.find("lever arm ");
  ASSERT_NE(arm, std::string::npos);
  EXPECT_NEAR(std::stod(found.text.substr(offset + 12)), 0.02, 0.003) << found.text;  // 1 cm on 50 changes of 5 m/s
  EXPECT_NEAR(std::stod(found.text.substr(arm + 10)), 2.0, 0.03) << found.text;
  EXPECT_EQ(found.errors.epochs.front().fix_type, FixType::Fixed);
  EXPECT_NEAR(found.errors.epochs.front().position_sigma_ned_m.z(), 0.02, 0.008);
}

TEST_F(FixErrorsOfAFile, WithAGeometryThatIsKnownKeepIt) {
  FixErrorOptions known = options();
  known.keep_geometry = true;
  known.time_offset_s = 0.02;
  known.lever_arm_v_m = {2.0, 1.0, 0.0};
  const FixErrors found = extract_fix_errors(known);
  Vector3 sum = Vector3::Zero();
  for (const auto& epoch : found.errors.epochs) sum += epoch.position_ned_m / 50.0;
  EXPECT_LT(sum.head<2>().norm(), 0.01);
  EXPECT_EQ(found.text.find("lever arm"), std::string::npos);
}

TEST_F(FixErrorsOfAFile, ComeBackFromTheirFile) {
  const FixErrors found = extract_fix_errors(options());
  recordings::write_fix_errors(path("errors.csv"), found.errors);
  const RecordedFixErrors read = recordings::read_fix_errors(path("errors.csv"));
  ASSERT_EQ(read.epochs.size(), found.errors.epochs.size());
  for (std::size_t i = 0; i < read.epochs.size(); ++i) {
    EXPECT_EQ(read.epochs[i].time, found.errors.epochs[i].time);
    EXPECT_LT((read.epochs[i].position_ned_m - found.errors.epochs[i].position_ned_m).norm(), 1e-6);
  }
  EXPECT_EQ(fix_profile_of(path("errors.csv")).recorded_error.file, "errors.csv");
}

TEST_F(FixErrorsOfAFile, ThatAreDamagedAreRefusedByLineAndColumn) {
  recordings::write_fix_errors(path("errors.csv"), extract_fix_errors(options()).errors);
  const std::string good = contents(path("errors.csv"));
  const auto refusal = [&](const std::string& from, const std::string& to) -> std::string {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    put(path("bad.csv"), text);
    try {
      recordings::read_fix_errors(path("bad.csv"));
    } catch (const files::ReadError& error) {
      return std::string(error.what()).substr(path("bad.csv").size());
    }
    return "";
  };
  EXPECT_EQ(refusal("fix_type", "type").substr(0, 60),
            std::string(": line 1 is not what `inslab graft extract-gnss` writes there").substr(0, 60));
  EXPECT_EQ(refusal(",fixed\n", ",solid\n"),
            ": line 2, column 14: is 'solid'; expected single, differential, float or fixed");
  EXPECT_EQ(refusal("\n1.000000000", "\n0.000000000"), ": line 3: its time is not after the one before");
  EXPECT_EQ(refusal("\n1.000000000", "\nnow"), ": line 3, column 1: is 'now'; expected a time in seconds");
}

}  // namespace fix_errors_test
}  // namespace inslab::graft
