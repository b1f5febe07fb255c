#include "inslab/models/gnss/constellation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::gnss {
namespace constellation_test {

using units::kDeg;

const nav::Geodetic kAntenna{0.5, 2.0, 100.0};

Vector3 satellite_seen_at(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kDeg, elevation = elevation_deg * kDeg;
  const Vector3 sight_n(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                        -std::sin(elevation));
  return nav::ecef_from_geodetic(kAntenna) + 2e7 * (nav::C_en(kAntenna.latitude_rad, kAntenna.longitude_rad) * sight_n);
}

TEST(Geometry, HasTheDopsOfOneSatelliteOverheadAndThreeOnTheHorizon) {
  // G^T G = diag(3/2, 3/2) and [1, -1; -1, 4]: HDOP^2 = 2/3 + 2/3, VDOP^2 = 4/3.
  const std::vector<Vector3> sky{satellite_seen_at(0, 90), satellite_seen_at(0, 0), satellite_seen_at(120, 0),
                                 satellite_seen_at(240, 0)};
  const Geometry geometry = geometry_of(kAntenna, sky, -1e-6);
  EXPECT_EQ(geometry.satellites, 4U);
  EXPECT_NEAR(geometry.hdop, std::sqrt(4.0 / 3.0), 1e-12);
  EXPECT_NEAR(geometry.vdop, std::sqrt(4.0 / 3.0), 1e-12);
}

TEST(Geometry, CountsWhatStandsAboveTheMask) {
  const std::vector<Vector3> sky{satellite_seen_at(0, 90),   satellite_seen_at(10, 20),  satellite_seen_at(100, 16),
                                 satellite_seen_at(190, 30), satellite_seen_at(280, 14), satellite_seen_at(300, -5)};
  EXPECT_EQ(geometry_of(kAntenna, sky, 15.0 * kDeg).satellites, 4U);
  EXPECT_EQ(geometry_of(kAntenna, sky, 10.0 * kDeg).satellites, 5U);
}

TEST(Geometry, HasNoDopsOfThreeSatellitesAndTheLargestOfACone) {
  const std::vector<Vector3> three{satellite_seen_at(0, 90), satellite_seen_at(0, 20), satellite_seen_at(120, 20)};
  EXPECT_EQ(geometry_of(kAntenna, three, 0.0).hdop, 0.0);
  // All at one elevation: height and clock cannot be told apart.
  const std::vector<Vector3> cone{satellite_seen_at(0, 40), satellite_seen_at(90, 40), satellite_seen_at(180, 40),
                                  satellite_seen_at(270, 40)};
  EXPECT_EQ(geometry_of(kAntenna, cone, 0.0).vdop, kMaxDop);
}

TEST(Constellation, FliesAtTheRadiusAndInclinationOfItsTable) {
  const auto satellites = satellites_e_m(SatelliteModel::GpsGalileo, {2446, 0});
  ASSERT_EQ(satellites.size(), 48U);
  ASSERT_EQ(satellites_e_m(SatelliteModel::Gps, {2446, 0}).size(), 24U);
  EXPECT_TRUE(satellites_e_m(SatelliteModel::Stated, {2446, 0}).empty());
  for (std::size_t i = 0; i < satellites.size(); ++i) {
    const double radius_m = i < 24 ? 26559.7e3 : 29599.8e3;
    EXPECT_NEAR(satellites[i].norm(), radius_m, 1e-6) << i;
    EXPECT_LE(std::abs(satellites[i].z()), radius_m * std::sin((i < 24 ? 55.0 : 56.0) * kDeg)) << i;
  }
}

TEST(Constellation, HasGpsOverTheLongitudesOfItsTableAtTheEpoch) {
  // 1993-07-01 00:00 UTC is 4 days and 9 s into week 703; the satellite in slot A3 (11.676 deg past its node, which
  // lies at 272.847 - 279.06 deg) stands at atan2(cos 55 sin u, cos u) east of the node.
  const Vector3 a3 = satellites_e_m(SatelliteModel::Gps, {703, (4 * 86400 + 9) * 1'000'000'000LL})[2];
  const double u = 11.676 * kDeg;
  const double east_of_node = std::atan2(std::cos(55.0 * kDeg) * std::sin(u), std::cos(u));
  EXPECT_NEAR(std::atan2(a3.y(), a3.x()), (272.847 - 279.06) * kDeg + east_of_node, 1e-12);
  EXPECT_NEAR(a3.z(), 26559.7e3 * std::sin(55.0 * kDeg) * std::sin(u), 1e-6);
}

/// The largest distance of a satellite from where it, or another of its plane, was `apart` before.
double largest_move_m(SatelliteModel model, std::size_t first, const time::GpsTime& time, time::Nanoseconds apart) {
  const auto before = satellites_e_m(model, time), after = satellites_e_m(model, time + apart);
  double largest_m = 0.0;
  for (std::size_t i = first; i < after.size(); ++i) {
    double nearest_m = 1e9;
    for (std::size_t j = first; j < before.size(); ++j) nearest_m = std::min(nearest_m, (after[i] - before[j]).norm());
    largest_m = std::max(largest_m, nearest_m);
  }
  return largest_m;
}

TEST(Constellation, RepeatsItsGroundTracks) {
  // GPS after a sidereal day: what is left is the rounding of the argument, 3e-11 rad after 33 years, and of the day to
  // nanoseconds at 3 km/s.
  const double sidereal_day_s = 2.0 * units::kPi / nav::wgs84::omega_e_rad_per_s;
  EXPECT_LT(largest_move_m(SatelliteModel::Gps, 0, {2446, 0}, time::from_seconds(sidereal_day_s)), 0.01);
  // Galileo after 17 revolutions in ten days (its published rates have eight digits): 0.01 deg.
  const double revolutions_s = 17.0 * 360.0 / 613.72253566 * 86400.0;
  EXPECT_LT(largest_move_m(SatelliteModel::GpsGalileo, 24, {2446, 0}, time::from_seconds(revolutions_s)), 5000.0);
}

TEST(Constellation, OfGpsMeetsThePublishedAvailabilityOfItsGeometry) {
  // GPS SPS Performance Standard (2001), section 3.2: PDOP of 6 or less, mask 5 deg, 24 hours: 98 % of the globe on
  // average, 88 % at the worst site. The 24 slots alone, none out of service, do better.
  double weight = 0.0, good = 0.0, worst = 1.0;
  for (double latitude = -80.0; latitude <= 80.0; latitude += 20.0) {
    for (double longitude = -180.0; longitude < 180.0; longitude += 45.0) {
      const nav::Geodetic site{latitude * kDeg, longitude * kDeg, 0.0};
      double here = 0.0;
      for (std::int64_t quarter = 0; quarter < 96; ++quarter) {
        const auto sky = satellites_e_m(SatelliteModel::Gps, {2446, quarter * 900'000'000'000LL});
        const Geometry geometry = geometry_of(site, sky, 5.0 * kDeg);
        ASSERT_GE(geometry.satellites, kFewestSatellites);
        here += std::hypot(geometry.hdop, geometry.vdop) <= 6.0 ? 1.0 / 96.0 : 0.0;
      }
      weight += std::cos(site.latitude_rad);
      good += here * std::cos(site.latitude_rad);
      worst = std::min(worst, here);
    }
  }
  EXPECT_GE(good / weight, 0.98);
  EXPECT_GE(worst, 0.88);
}

}  // namespace constellation_test
}  // namespace inslab::gnss
