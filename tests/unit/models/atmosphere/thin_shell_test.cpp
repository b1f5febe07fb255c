#include "inslab/models/atmosphere/thin_shell.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::atmosphere {
namespace thin_shell_test {

const time::GpsTime kBegin{2401, 0};
const nav::Geodetic kPlace{0.5, 0.3, 0.0};

/// At 14:00 local time of a longitude.
time::GpsTime afternoon_at(double longitude_rad) {
  return kBegin + time::from_seconds(86400.0 + 3600.0 * (14.0 - 12.0 * longitude_rad / units::kPi));
}

TEST(PiercePoint, AboveTheAntennaAtTheZenith) {
  const PiercePoint point = pierce_point(kPlace, 1.0, units::kPi / 2.0);
  EXPECT_NEAR(point.latitude_rad, kPlace.latitude_rad, 1e-15);
  EXPECT_NEAR(point.longitude_rad, kPlace.longitude_rad, 1e-15);
  EXPECT_NEAR(point.obliquity, 1.0, 1e-15);
}

// The triangle of the Earth's centre, the antenna and the point, in Cartesian coordinates.
TEST(PiercePoint, LiesOnTheLineOfSight) {
  for (const double azimuth : {0.3, 2.0, 4.5}) {
    for (const double elevation : {0.1, 0.7}) {
      const PiercePoint point = pierce_point(kPlace, azimuth, elevation);
      const auto on_sphere = [](double latitude, double longitude, double radius) -> nav::Vector3 {
        return radius * nav::Vector3(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                                     std::sin(latitude));
      };
      const nav::Vector3 antenna = on_sphere(kPlace.latitude_rad, kPlace.longitude_rad, 6371e3);
      const nav::Vector3 shell = on_sphere(point.latitude_rad, point.longitude_rad, 6821e3);
      const nav::Vector3 line_n =
          nav::C_en(kPlace.latitude_rad, kPlace.longitude_rad).transpose() * (shell - antenna).normalized();
      EXPECT_NEAR(std::asin(-line_n.z()), elevation, 1e-9);
      EXPECT_NEAR(std::remainder(std::atan2(line_n.y(), line_n.x()) - azimuth, 2.0 * units::kPi), 0.0, 1e-9);
      EXPECT_NEAR(1.0 / point.obliquity, (shell - antenna).normalized().dot(shell.normalized()), 1e-9);
    }
  }
}

TEST(ThinShell, BulgeStandsAtTwoInTheAfternoon) {
  const ThinShell shell(1, {kPlace, 5.0, 20.0, 0.0, 0.0, 0.0}, kBegin);
  const time::GpsTime noon = afternoon_at(kPlace.longitude_rad);
  EXPECT_NEAR(shell.vertical_tecu(0.5, 0.3, noon), 25.0, 1e-9);
  // 14/3 h later half a cosine of 28 h is at a half, 10 h later it is night.
  EXPECT_NEAR(shell.vertical_tecu(0.5, 0.3, noon + std::chrono::seconds(16800)), 15.0, 1e-9);
  EXPECT_NEAR(shell.vertical_tecu(0.5, 0.3, noon + std::chrono::hours(10)), 5.0, 1e-9);
  EXPECT_NEAR(shell.slant_tecu(kPlace, 0.0, units::kPi / 2.0, noon), 25.0, 1e-9);
}

TEST(ThinShell, GradientIsPerHundredKilometres) {
  const ThinShell shell(1, {kPlace, 50.0, 0.0, 2.0, -3.0, 0.0}, kBegin);
  EXPECT_NEAR(shell.vertical_tecu(0.5 + 1e5 / 6371e3, 0.3, kBegin), 52.0, 1e-9);
  EXPECT_NEAR(shell.vertical_tecu(0.5, 0.3 + 1e5 / (6371e3 * std::cos(0.5)), kBegin), 47.0, 1e-9);
}

// 32 waves of one amplitude, at points that fill 6000 km by 6000 km and a day evenly (an additive recurrence): no two
// waves keep step over so much, so their mean square is what is asked for within 1 / sqrt(2 N) = 0.4 % of N values.
TEST(ThinShell, WavesHaveTheirRms) {
  const ThinShell shell(7, {kPlace, 50.0, 0.0, 0.0, 0.0, 2.0}, kBegin);
  double squares = 0.0;
  constexpr int kSamples = 40000;
  for (int i = 0; i < kSamples; ++i) {
    const auto part = [i](double step) { return std::fmod(i * step, 1.0); };
    const auto after = time::Nanoseconds(std::llround(86400e9 * part(0.5497004779)));
    const double off = shell.vertical_tecu(part(0.8191725134), part(0.6710436067), kBegin + after) - 50.0;
    squares += off * off;
  }
  EXPECT_NEAR(std::sqrt(squares / kSamples), 2.0, 0.03);
}

// Along any line they change over 50 km, but by little over 1 km: at most 2 pi / 50 km of the sum of all amplitudes.
TEST(ThinShell, WavesAreBetween50And500Kilometres) {
  const ThinShell shell(7, {kPlace, 50.0, 0.0, 0.0, 0.0, 2.0}, kBegin);
  double most_change = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double latitude = 0.4 + i * 1e-4;
    const double change =
        shell.vertical_tecu(latitude + 1e3 / 6371e3, 0.3, kBegin) - shell.vertical_tecu(latitude, 0.3, kBegin);
    most_change = std::max(most_change, std::abs(change));
  }
  EXPECT_LT(most_change, 2.0 * units::kPi / 50.0 * 2.0 * std::sqrt(2.0 * 32.0));
  EXPECT_GT(most_change, 2.0 * units::kPi / 500.0);
}

TEST(ThinShell, SeedsHaveTheirOwnWavesAndCallsNoMemory) {
  const ThinShellParameters parameters{kPlace, 50.0, 0.0, 0.0, 0.0, 2.0};
  const ThinShell one(7, parameters, kBegin), same(7, parameters, kBegin), other(8, parameters, kBegin);
  const time::GpsTime later = kBegin + std::chrono::hours(30);
  const double first = one.vertical_tecu(0.51, 0.31, later);
  one.vertical_tecu(0.2, 0.1, kBegin);
  EXPECT_EQ(one.vertical_tecu(0.51, 0.31, later), first);
  EXPECT_EQ(same.vertical_tecu(0.51, 0.31, later), first);
  EXPECT_NE(other.vertical_tecu(0.51, 0.31, later), first);
}

// 1 TECU is 0.162 m at L1.
TEST(ThinShell, DelayOfATecu) { EXPECT_NEAR(ionosphere_delay_m(1.0, 1575.42e6), 0.1624, 1e-4); }

}  // namespace thin_shell_test
}  // namespace inslab::atmosphere
