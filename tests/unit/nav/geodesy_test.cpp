#include "inslab/nav/geodesy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {
namespace geodesy_test {

// A coordinate of 4.2e6 to 8.4e6 m has a unit in the last place of 9.3e-10 m.
constexpr double kEcefTolerance_m = 1e-9;

Geodetic degrees(double latitude, double longitude, double height) {
  return {latitude * units::kDeg, longitude * units::kDeg, height};
}

TEST(Wgs84, RadiiOfCurvatureMeetAtThePoleAndDifferAtTheEquator) {
  // a(1 - e2) and a at the equator, a^2/b at the pole: closed forms of (3-28), (3-29); rounding 1e-9 m.
  EXPECT_NEAR(wgs84::meridian_radius_m(0.0), 6335439.32729282, 1e-8);
  EXPECT_NEAR(wgs84::transverse_radius_m(0.0), 6378137.0, 1e-9);
  EXPECT_NEAR(wgs84::meridian_radius_m(units::kPi / 2), 6399593.62575849, 1e-8);
  EXPECT_NEAR(wgs84::transverse_radius_m(units::kPi / 2), 6399593.62575849, 1e-8);
}

TEST(Ecef, EqualsThePublishedPointOfErfa) {
  // ERFA, t_erfa_c.c, expectations of eraGd2gc for WGS84 (radians and metres).
  const Vector3 r_e = ecef_from_geodetic({-0.5, 3.1, 2500.0});
  EXPECT_NEAR(r_e.x(), -5599000.5577049947, kEcefTolerance_m);
  EXPECT_NEAR(r_e.y(), 233011.67223479203, kEcefTolerance_m);
  EXPECT_NEAR(r_e.z(), -3040909.4706983363, kEcefTolerance_m);
}

TEST(Ecef, EqualsGeographicLibToANanometre) {
  // Made with GeographicLib 2.1.2, nine decimals. Its input is degrees; ours is rounded to radians first, which moves
  // the point by up to 1.4e-9 m: the expected point is moved by what the rounding took away.
  struct Row {
    long double latitude_deg, longitude_deg;
    double height_m, x_m, y_m, z_m;
  };
  const Row rows[] = {
      {0.0L, 0.0L, 0, 6378137.0, 0.0, 0.0},
      {0.0L, 180.0L, 0, -6378137.0, 0.0, 0.0},
      {0.0L, -180.0L, 0, -6378137.0, 0.0, 0.0},
      {0.0L, 90.0L, 100, 0.0, 6378237.0, 0.0},
      {45.0L, 45.0L, 1000, 3194919.145060575, 3194919.145060574, 4488055.515647106},
      {-45.0L, -45.0L, -100, 3194369.145060574, -3194369.145060574, -4487277.698187801},
      // Its own sum is 1.03e-9 m short here: with forty digits it is ...047030.
      {89.9L, 10.0L, 0, 10999.704006047030, 1939.544596073, 6356742.567109314},
      {-79.9L, 170.0L, 10, -1105113.100182042, 194861.256296471, -6257604.262304600},
      {51.1166L, -114.0383L, 1063.6093, -1634525.186006844, -3664609.057281158, 4942525.639349404},
      {60.0L, 5.0L, 0, 3184938.638738436, 278646.024915301, 5500477.133938639},
      {78.0L, 15.0L, 0, 1285025.758478599, 344321.614237531, 6216936.500363830},
      {1e-9L, 1e-9L, 0, 6378137.0, 0.000111319, 0.000110574},
      {-33.8L, 151.2L, 30, -4649382.093501540, 2556019.435724233, -3528050.173052720},
      {48.8583701L, 2.2944813L, 340, 4201161.889744731, 168330.787019489, 4780466.903744249},
      {37.4L, -122.1L, 20000, -2704309.563165776, -4311038.834990196, 3864900.605074601},
      {0.0001L, 179.9999L, 0, -6378136.999980636, 11.131949080, 11.057427582},
      {0.0001L, -179.9999L, 0, -6378136.999980636, -11.131949080, 11.057427582},
      {83.99L, 33.0L, 0, 561930.873953805, 364922.176397714, 6321579.772563082},
  };
  constexpr long double kRadPerDegree = 3.14159265358979323846264L / 180.0L;
  for (const Row& row : rows) {
    const long double latitude = row.latitude_deg * kRadPerDegree, longitude = row.longitude_deg * kRadPerDegree;
    const Geodetic position{static_cast<double>(latitude), static_cast<double>(longitude), row.height_m};
    const double s = std::sin(position.latitude_rad), c = std::cos(position.latitude_rad);
    const double north_m = static_cast<double>(latitude - static_cast<long double>(position.latitude_rad)) *
                           (wgs84::meridian_radius_from_sine_m(s) + row.height_m);
    const double east_m = static_cast<double>(longitude - static_cast<long double>(position.longitude_rad)) *
                          (wgs84::transverse_radius_from_sine_m(s) + row.height_m) * c;
    const Vector3 moved = C_en(position.latitude_rad, position.longitude_rad) * Vector3(north_m, east_m, 0.0);
    const Vector3 r_e = ecef_from_geodetic(position) + moved;
    // Half a unit in the last place of GeographicLib's own double, 4.7e-10 m, and its nine decimals are in this too.
    EXPECT_NEAR(r_e.x(), row.x_m, kEcefTolerance_m) << static_cast<double>(row.latitude_deg);
    EXPECT_NEAR(r_e.y(), row.y_m, kEcefTolerance_m) << static_cast<double>(row.latitude_deg);
    EXPECT_NEAR(r_e.z(), row.z_m, kEcefTolerance_m) << static_cast<double>(row.latitude_deg);
  }
}

TEST(NedFrom, EqualsGeographicLibsLocalCartesian) {
  // GeographicLib 2.1.2, LocalCartesian about 30.46 deg N, 114.47 deg E, 22 m; east, north, up to nine decimals. The
  // angles of both points are rounded to radians (2.2e-16 rad of longitude, 1.4e-9 m, twice; latitude 0.4e-9 m, twice).
  struct Row {
    double latitude_deg, longitude_deg, height_m, east_m, north_m, up_m;
  };
  const Row rows[] = {{30.41, 114.37, 2, -9608.717282454, -5538.740577868, -29.646476695},
                      {30.41, 114.37, 522, -9609.499994463, -5539.194017155, 490.352736530},
                      {30.46, 114.47, 522, 0.0, 0.0, 499.999999999},
                      {30.461, 114.472, 22, 192.075070360, 110.862322921, -0.003857104},
                      {30.66, 114.87, 2, 38336.271938962, 22240.186742697, -174.048352054}};
  const Geodetic origin = degrees(30.46, 114.47, 22.0);
  for (const Row& row : rows) {
    const Vector3 ned = ned_from(origin, degrees(row.latitude_deg, row.longitude_deg, row.height_m));
    EXPECT_NEAR(ned.y(), row.east_m, 2.0 * 1.4e-9 + 1e-9);
    EXPECT_NEAR(ned.x(), row.north_m, 2.0 * 0.4e-9 + 1e-9);
    EXPECT_NEAR(-ned.z(), row.up_m, 1e-9);
  }
}

TEST(Ecef, AndBackIsTheSamePointToANanometreAllOverTheDomain) {
  // The coordinates between are rounded to doubles, 4.7e-10 m each, so the point itself lies up to sqrt(3) of
  // that, 8.1e-10 m, away. The angles that come back are rounded by half a unit in the last place: latitude 1.1e-16 rad
  // (0.7e-9 m) and longitude 2.2e-16 rad (1.4e-9 m); the height's rounding is 7e-12 m.
  const double point_m = 8.1e-10;
  std::mt19937_64 generator(20240102);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const Geodetic position =
        degrees(89.9 * unit(generator), 180.0 * unit(generator), 49500.0 + 50500.0 * unit(generator));
    const Geodetic back = geodetic_from_ecef(ecef_from_geodetic(position));
    const double radius_m = wgs84::a_m + position.height_m;
    EXPECT_NEAR(back.height_m, position.height_m, point_m + 2e-11);
    EXPECT_NEAR((back.latitude_rad - position.latitude_rad) * radius_m, 0.0, point_m + 1.12e-16 * radius_m);
    const double parallel_m = radius_m * std::cos(position.latitude_rad);
    EXPECT_NEAR(wrapped_to_pi(back.longitude_rad - position.longitude_rad) * parallel_m, 0.0,
                point_m + 2.23e-16 * parallel_m + 0.1e-9);
  }
}

TEST(Ecef, OfAPoleHasLongitudeZeroAndTheRightHeight) {
  const Geodetic pole = geodetic_from_ecef({0.0, 0.0, -wgs84::b_m - 12.5});
  EXPECT_DOUBLE_EQ(pole.latitude_rad, -units::kPi / 2);
  EXPECT_EQ(pole.longitude_rad, 0.0);
  EXPECT_NEAR(pole.height_m, 12.5, 1e-9);
}

TEST(Ecef, InsideTheEarthIsRefused) {
  EXPECT_THROW(geodetic_from_ecef({0.0, 0.0, 0.0}), std::domain_error);
  EXPECT_THROW(geodetic_from_ecef({std::nan(""), 0.0, 6.4e6}), std::domain_error);
}

TEST(NavigationFrame, IsNorthEastDown) {
  const Matrix3 C = C_en(0.0, 0.0);
  EXPECT_EQ(C * Vector3::UnitX(), Vector3::UnitZ());
  EXPECT_EQ(C * Vector3::UnitY(), Vector3::UnitY());
  EXPECT_EQ(C * Vector3::UnitZ(), -Vector3::UnitX());
  const Matrix3 R = C_en(0.6, -2.2);
  EXPECT_LT((R * R.transpose() - Matrix3::Identity()).norm(), 1e-15);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-15);
}

TEST(Displaced, EqualsGeographicLibsEcefAfterAnArm) {
  // The arm seen in ECEF: the two positions' own rounding (9.3e-10 m in each coordinate) is all that may differ.
  const Geodetic origin = degrees(30.53, 114.35, 20.0);
  const Vector3 arm_n(0.8, -1.2, -1.5);
  const Vector3 expected = ecef_from_geodetic(origin) + C_en(origin.latitude_rad, origin.longitude_rad) * arm_n;
  EXPECT_LT((ecef_from_geodetic(displaced(origin, arm_n)) - expected).norm(), 4e-9);
}

TEST(Displaced, KeepsAnArmOfAMetreToItsOwnRounding) {
  const Geodetic origin = degrees(30.53, 114.35, 20.0);
  const Vector3 arm_n(0.3, 0.7, -1.0);
  const Geodetic change = geodetic_change(origin, arm_n);
  const double s = std::sin(origin.latitude_rad);
  const double M = wgs84::meridian_radius_from_sine_m(s), N = wgs84::transverse_radius_from_sine_m(s);
  // Second order of the arm, by hand; the third order, 1e-14 of the arm, is left out:
  //   dlat = north/(M+h+up) - M'/M north^2/(2 (M+h)^2) - tan(lat) east^2/(2 (N+h)(M+h)),  M'/M = 3 e2 s c/(1 - e2 s^2)
  const double dM_over_M = 3.0 * wgs84::e2 * s * std::cos(origin.latitude_rad) / (1.0 - wgs84::e2 * s * s);
  const double up = -arm_n.z(), h = origin.height_m;
  const double latitude = arm_n.x() / (M + h + up) - 0.5 * dM_over_M * arm_n.x() * arm_n.x() / ((M + h) * (M + h)) -
                          std::tan(origin.latitude_rad) * arm_n.y() * arm_n.y() / (2.0 * (N + h) * (M + h));
  const double longitude = arm_n.y() / ((N + h + up) * std::cos(origin.latitude_rad) - arm_n.x() * s);
  const double height = up + 0.5 * (arm_n.x() * arm_n.x() / (M + h) + arm_n.y() * arm_n.y() / (N + h));
  EXPECT_NEAR(change.latitude_rad * M, latitude * M, 1e-12);
  EXPECT_NEAR(change.longitude_rad * N, longitude * N, 1e-12);
  EXPECT_NEAR(change.height_m, height, 1e-12);
}

TEST(Displaced, IsUndoneByNedFromUpToAThousandKilometres) {
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Geodetic origin = degrees(80.0 * unit(generator), 180.0 * unit(generator), 5000.0);
    const double length_m = std::pow(10.0, 3.0 + 3.0 * unit(generator));
    const Vector3 line = length_m * Vector3(unit(generator), unit(generator), 0.1 * unit(generator));
    const Vector3 back = ned_from(origin, displaced(origin, line));
    // Half units in the last place of the end's angles: 2.2e-16 rad of longitude, 1.1e-16 of latitude; and 1e-15 of
    // the line's length.
    EXPECT_LT((back - line).norm(), 2.5e-9 + 2e-15 * length_m) << i;
  }
}

TEST(Displaced, CrossesTheAntimeridian) {
  const Geodetic east_of_it = displaced(degrees(10.0, 179.9999999, 0.0), {0.0, 100.0, 0.0});
  EXPECT_LT(east_of_it.longitude_rad, -3.14);
  EXPECT_NEAR(ned_from(degrees(10.0, 179.9999999, 0.0), east_of_it).y(), 100.0, 3e-9);
}

TEST(EarthRate, HasTheLatitudesShares) {
  const Vector3 rate = omega_ie_n(30.0 * units::kDeg);
  EXPECT_NEAR(rate.x(), 7.292115e-5 * std::sqrt(0.75), 2e-20);
  EXPECT_EQ(rate.y(), 0.0);
  EXPECT_NEAR(rate.z(), -7.292115e-5 * 0.5, 1e-20);
}

TEST(TransportRate, TurnsTheNavigationFrameAsThePositionMoves) {
  // C_en(t)' = C_en omega_en x, by central differences over 2 ms: truncation (dt^2 omega^2) 1e-16, rounding 1e-16/2e-3.
  const Geodetic position = degrees(52.0, 13.0, 300.0);
  const Vector3 v_n(120.0, -80.0, 5.0);
  const double dt_s = 1e-3;
  const double s = std::sin(position.latitude_rad);
  const double latitude_step = dt_s * v_n.x() / (wgs84::meridian_radius_from_sine_m(s) + position.height_m);
  const double longitude_step =
      dt_s * v_n.y() /
      ((wgs84::transverse_radius_from_sine_m(s) + position.height_m) * std::cos(position.latitude_rad));
  const Matrix3 before = C_en(position.latitude_rad - latitude_step, position.longitude_rad - longitude_step);
  const Matrix3 after = C_en(position.latitude_rad + latitude_step, position.longitude_rad + longitude_step);
  const Matrix3 rate =
      C_en(position.latitude_rad, position.longitude_rad).transpose() * (after - before) / (2.0 * dt_s);
  const Vector3 omega = omega_en_n(position, v_n);
  EXPECT_NEAR(rate(2, 1), omega.x(), 5e-13);
  EXPECT_NEAR(rate(0, 2), omega.y(), 5e-13);
  EXPECT_NEAR(rate(1, 0), omega.z(), 5e-13);
}

TEST(Domain, IsRefusedOutsideWithQuantityAndLimits) {
  EXPECT_TRUE(in_domain(degrees(89.9, 0.0, -1000.0)));
  EXPECT_NO_THROW(check_domain(degrees(-89.9, 200.0, 100000.0)));
  const auto message = [](const Geodetic& position) -> std::string {
    try {
      check_domain(position);
    } catch (const std::domain_error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message(degrees(0.0, 0.0, 100001.0)), "height is 100001 m, outside the valid domain of -1000 to 100000 m");
  EXPECT_EQ(message(degrees(89.95, 0.0, 0.0)), "latitude is 89.95 deg, outside the valid domain of -89.9 to 89.9 deg");
  EXPECT_NE(message(degrees(std::nan(""), 0.0, 0.0)), "");
  EXPECT_NE(message(degrees(0.0, std::nan(""), 0.0)), "");
  EXPECT_NE(message(degrees(0.0, 0.0, std::nan(""))), "");
}

}  // namespace geodesy_test
}  // namespace inslab::nav
