#include "inslab/referee/calibrate/yaw_uncertainty.hpp"

#include <gmock/gmock.h>

#include <functional>
#include <random>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/referee/calibrate/alignment_report.hpp"

namespace inslab::calibrate {
namespace yaw_uncertainty_test {

using testing::HasSubstr;

constexpr double kLatitudeDeg = 30.53;
constexpr double kLatitude_rad = kLatitudeDeg * units::kDeg;
constexpr double kGravity_m_per_s2 = 9.793;
constexpr double kDt_s = 0.02;
/// 15.04 deg/h cos(30.53 deg).
constexpr double kHorizontalDegPerH = 12.955;

/// A half-hour at a yaw with a gyro bias in n, white noise, and a tilt about east by time.
struct Rest {
  double yaw_deg = 0.0;
  nav::Vector3 gyro_bias_n_deg_per_h = nav::Vector3::Zero();
  double arw_deg_per_sqrt_h = 0.0;
  double force_noise_m_per_s2 = 0.0;
  std::function<double(double)> tilt_east_rad = [](double) { return 0.0; };
  int duration_s = 1800;
  std::optional<double> given_bias_deg_per_h;
  std::uint64_t seed = 1;

  AlignmentResult aligned() const {
    std::optional<double> given = given_bias_deg_per_h;
    if (given) *given *= units::kDegPerH;
    StaticAlignment alignment(kDt_s, kLatitude_rad, kGravity_m_per_s2, {}, given);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto noise = [&](double sigma) {
      return sigma > 0.0 ? nav::Vector3(sigma * nav::Vector3(normal(random), normal(random), normal(random)))
                         : nav::Vector3::Zero();
    };
    const nav::Matrix3 C_hb = nav::matrix_from_rpy({0.0, 0.0, yaw_deg * units::kDeg});
    const auto at = [&](double t_s) {
      return nav::Matrix3(Eigen::AngleAxisd(tilt_east_rad(t_s), nav::Vector3::UnitY()).toRotationMatrix() * C_hb);
    };
    for (int k = 0; k < static_cast<int>(duration_s / kDt_s + 0.5); ++k) {
      const double begin_s = k * kDt_s, end_s = begin_s + kDt_s;
      const nav::Matrix3 C_nb = at(begin_s + 0.5 * kDt_s);
      const nav::Vector3 turn_n(0.0, tilt_east_rad(end_s) - tilt_east_rad(begin_s), 0.0);
      const nav::Vector3 rate_n = nav::omega_ie_n(kLatitude_rad) + gyro_bias_n_deg_per_h * units::kDegPerH;
      alignment.add(
          C_nb.transpose() * (rate_n * kDt_s + turn_n) +
              noise(arw_deg_per_sqrt_h * units::kDegPerSqrtH * std::sqrt(kDt_s)),
          C_nb.transpose() * nav::Vector3(0.0, 0.0, -kGravity_m_per_s2 * kDt_s) + noise(force_noise_m_per_s2 * kDt_s));
    }
    return alignment.result();
  }
};

double yaw_off_deg(const AlignmentResult& result, const Rest& rest) {
  return nav::wrapped_to_pi(result.whole->yaw_rad - rest.yaw_deg * units::kDeg) * units::kDegPerRad;
}
double yaw_sigma_deg(const AlignmentResult& result) { return result.yaw->sigma_rad * units::kDegPerRad; }

TEST(YawUncertainty, ATacticalGyrosYawIsWarnedOf) {
  Rest rest;
  rest.yaw_deg = 30.0;
  // 7.3 deg/h on each axis of an IMU that looks 60 deg further.
  rest.gyro_bias_n_deg_per_h = {-2.67, 9.97, 7.3};
  const AlignmentResult result = rest.aligned();
  EXPECT_NEAR(std::abs(yaw_off_deg(result, rest)), 44.1, 0.5);
  // What shows of the bias: 7.3 deg/h along gravity and hypot(12.955 - 2.67, 9.97) - 12.955 = 1.37 of the length.
  EXPECT_NEAR(result.yaw->shown_bias_rad_per_s / units::kDegPerH, 5.25, 0.02);
  EXPECT_NEAR(yaw_sigma_deg(result), 5.25 / kHorizontalDegPerH * units::kDegPerRad, 0.1);
  AlignedRecording aligned;
  aligned.alignment = result;
  EXPECT_THAT(warning_text(aligned, kLatitudeDeg),
              HasSubstr("yaw is not known: its standard deviation is 23.2 deg; 5 deg of yaw needs gyros of 1.1 deg/h: "
                        "tactical grade at its best (1 deg/h)"));
  EXPECT_THAT(report_text(aligned, kLatitudeDeg, 0.1),
              HasSubstr("0.1 deg of yaw needs gyros of 0.023 deg/h: aviation grade (0.01 deg/h)"));
}

TEST(YawUncertainty, AGivenBiasCountsUnlessFarMoreShows) {
  Rest rest;
  rest.gyro_bias_n_deg_per_h = {0.0, 0.0, 1.0};
  rest.given_bias_deg_per_h = 0.5;
  const AlignmentResult result = rest.aligned();
  EXPECT_TRUE(result.yaw->bias_is_given);
  EXPECT_NEAR(yaw_sigma_deg(result), 0.5 / kHorizontalDegPerH * units::kDegPerRad, 0.01);
  AlignedRecording aligned;
  aligned.alignment = result;
  EXPECT_EQ(warning_text(aligned, kLatitudeDeg), "");
  rest.given_bias_deg_per_h = 0.01;
  EXPECT_FALSE(rest.aligned().yaw->bias_is_given);
  EXPECT_NEAR(rest.aligned().yaw->bias_rad_per_s / units::kDegPerH, std::sqrt(0.5), 1e-3);
}

TEST(YawUncertainty, IsNeverMoreThanThatOfAnyYaw) {
  EXPECT_DOUBLE_EQ(yaw_uncertainty({0.0, 0.0, 1e-3}, nav::Vector3::UnitZ(), kLatitude_rad, {}, {}, {}).sigma_rad,
                   units::kPi / std::sqrt(3.0));
}

// 100 runs: a standard deviation of theirs is itself known to 1/sqrt(200) = 7 %; 25 % is 3.5 times that.
TEST(YawUncertainty, OfNoiseIsWhatManyRunsSpreadBy) {
  Rest rest;
  rest.arw_deg_per_sqrt_h = 0.02;
  rest.duration_s = 60;
  rest.given_bias_deg_per_h = 1e-6;
  double squares = 0.0, noise = 0.0;
  for (rest.seed = 1; rest.seed <= 100; ++rest.seed) {
    const AlignmentResult result = rest.aligned();
    squares += std::pow(yaw_off_deg(result, rest), 2) / 100.0;
    noise += std::pow(result.yaw->noise_rad_per_s / result.yaw->horizontal_rad_per_s * units::kDegPerRad, 2) / 100.0;
  }
  EXPECT_NEAR(std::sqrt(noise), 0.02 * std::sqrt(60.0) / kHorizontalDegPerH * units::kDegPerRad, 0.03);
  EXPECT_NEAR(std::sqrt(squares / noise), 1.0, 0.25);
}

struct Course {
  const char* name;
  double (*tilt_east_rad)(double t_s);
};

class TiltTrendOfACourse : public testing::TestWithParam<Course> {};

TEST_P(TiltTrendOfACourse, GoesOutOfYaw) {
  Rest rest;
  rest.yaw_deg = 45.0;
  rest.tilt_east_rad = GetParam().tilt_east_rad;
  rest.force_noise_m_per_s2 = 1e-3;
  const AlignmentResult result = rest.aligned();
  ASSERT_TRUE(result.tilt->shows());
  // 0.33 deg/h over the Earth's 12.955 along north.
  EXPECT_NEAR(std::abs(nav::wrapped_to_pi(result.yaw_with_tilt_rad - rest.yaw_deg * units::kDeg)) * units::kDegPerRad,
              1.46, 0.02);
  EXPECT_NEAR(yaw_off_deg(result, rest), 0.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Settling, TiltTrendOfACourse,
    testing::Values(Course{"Steadily", [](double t_s) { return 0.33 * units::kDegPerH * t_s; }},
                    Course{"EverLess", [](double t_s) { return 0.165 * units::kDeg * -std::expm1(-t_s / 150.0); }}),
    [](const auto& course) { return course.param.name; });

TEST(TiltTrend, NamesTheAxisAboutWhichTheCarSettles) {
  Rest rest;
  rest.yaw_deg = 120.0;
  rest.tilt_east_rad = [](double t_s) { return 0.33 * units::kDegPerH * t_s; };
  AlignedRecording aligned;
  aligned.alignment = rest.aligned();
  EXPECT_THAT(
      report_text(aligned, kLatitudeDeg, 1.0),
      testing::AllOf(testing::ContainsRegex("Tilt's trend: [+-]0\\.000 deg/h about north, \\+0\\.330 about east"),
                     HasSubstr("left in, yaw would be 11")));
}

TEST(TiltTrend, NoiseAloneIsNone) {
  Rest rest;
  rest.force_noise_m_per_s2 = 0.015;
  rest.duration_s = 60;
  for (rest.seed = 1; rest.seed <= 20; ++rest.seed) EXPECT_FALSE(rest.aligned().tilt->shows());
}

TEST(TiltTrend, IsNotLookedForInAFewSeconds) { EXPECT_FALSE(tilt_trend(std::vector<SecondMeans>(9), 1.0)); }

TEST(TiltTrend, CountsSecondsAsLongAsTheSamplesMakeThem) {
  const double second_s = 1.04, rate_rad_per_s = 1e-6;  // 13 samples at 12.5 Hz
  const nav::Vector3 earth_b(5e-5, 0.0, -3e-5);
  std::vector<SecondMeans> seconds;
  for (int k = 0; k < 100; ++k) {
    const double angle = rate_rad_per_s * second_s * (k + 0.5);
    seconds.push_back(
        {earth_b + nav::Vector3(0.0, rate_rad_per_s, 0.0), 9.8 * nav::Vector3(std::sin(angle), 0.0, -std::cos(angle))});
  }
  const auto trend = tilt_trend(seconds, second_s);
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->omega_nb_b.y(), rate_rad_per_s, 1e-3 * rate_rad_per_s);
  EXPECT_LT((trend->omega_ie_b - earth_b).norm(), 1e-3 * rate_rad_per_s);
}

}  // namespace yaw_uncertainty_test
}  // namespace inslab::calibrate
