#include "nav/gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "nav/wgs84.hpp"

namespace inslab::nav {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

struct Row {
  double latitude_deg, height_m, gamma_up_m_per_s2;
};

// GeographicLib 2.1.2, NormalGravity::WGS84(): the exact normal field.
constexpr Row kOnTheEllipsoid[] = {{0, 0, -9.78032533590389},  {15, 0, -9.78378496235693}, {-30, 0, -9.79324726921932},
                                   {45, 0, -9.80619776937738}, {60, 0, -9.81917695311863}, {75, 0, -9.82869662748729},
                                   {90, 0, -9.8321849378634}};
constexpr Row kAbove[] = {
    {0, -100, -9.78063412293594},   {45, -100, -9.80650633640924},  {90, -100, -9.8324932838967},
    {0, 1000, -9.7772382645939},    {45, 1000, -9.80311289693238},  {90, 1000, -9.82910227425133},
    {0, 10000, -9.74951985825652},  {45, 10000, -9.77541418788896}, {90, 10000, -9.80142335092358},
    {30, 50000, -9.64070849319438}, {60, 50000, -9.66674588993931}};

TEST(Somigliana, EqualsTheExactNormalFieldOnTheEllipsoid) {
  for (const Row& row : kOnTheEllipsoid) {
    EXPECT_NEAR(Gravity().g_n({row.latitude_deg * kRadPerDeg, 0.0, 0.0}).z(), -row.gamma_up_m_per_s2, 1e-9);
  }
}

TEST(Somigliana, FollowsTheExactFieldWithHeightToTheNextTermOfTheSeries) {
  // Bruns' formula gives the exact linear term, -(gamma (1/M + 1/N) + 2 omega^2) h; the closed form has it to first
  // order in f and m, and the quadratic term 3 x^2 without any: 9 f x^2 is left out there, and 4 x^3 is the next term.
  for (const Row& row : kAbove) {
    const double s = std::sin(row.latitude_deg * kRadPerDeg);
    const double x = row.height_m / wgs84::a_m;
    const double gamma = Gravity().normal_m_per_s2(s, 0.0);
    const double bruns =
        wgs84::a_m * (1.0 / wgs84::meridian_radius_from_sine_m(s) + 1.0 / wgs84::transverse_radius_from_sine_m(s) +
                      2.0 * wgs84::omega_e_rad_per_s * wgs84::omega_e_rad_per_s / gamma);
    const double closed = 2.0 * (1.0 + wgs84::f + 0.00344978650684 - 2.0 * wgs84::f * s * s);
    const double left_out =
        9.8 * (std::abs(bruns - closed) * std::abs(x) + 9.0 * wgs84::f * x * x + 4.0 * std::abs(x * x * x));
    EXPECT_NEAR(Gravity().g_n({row.latitude_deg * kRadPerDeg, 0.0, row.height_m}).z(), -row.gamma_up_m_per_s2,
                left_out + 1e-9)
        << row.latitude_deg << " deg, " << row.height_m << " m";
  }
}

TEST(Series, IsWithinAMilligalOfTheClosedForm) {
  // GRS80 and WGS-84 share the ellipsoid to 0.1 mm; the series stops at sin^4: 0.0000001262 sin^6 g = 1.2e-6 m/s^2, and
  // its printed constants are those of GRS80's rounding, a few 1e-6 m/s^2 in all.
  const Gravity series(GravityModel::Series);
  for (double latitude_deg = -90.0; latitude_deg <= 90.0; latitude_deg += 7.5) {
    for (const double height_m : {0.0, 1000.0, 10000.0}) {
      const Geodetic position{latitude_deg * kRadPerDeg, 0.0, height_m};
      EXPECT_NEAR(series.g_n(position).z(), Gravity().g_n(position).z(), 1e-5) << latitude_deg << ' ' << height_m;
    }
  }
}

TEST(Disturbance, AddsMilligalsDownAndTiltsThePlumbLine) {
  const Geodetic position{0.5, 1.0, 100.0};
  const double normal = Gravity().g_n(position).z();
  const Vector3 g_n = Gravity(GravityModel::Somigliana, {20.0, 5.0, -3.0}).g_n(position);
  EXPECT_NEAR(g_n.z(), normal + 20e-5, 1e-15);
  // One arcsec is 4.8481368e-6 rad.
  EXPECT_NEAR(g_n.x(), -(normal + 20e-5) * 5.0 * 4.84813681109536e-6, 1e-15);
  EXPECT_NEAR(g_n.y(), (normal + 20e-5) * 3.0 * 4.84813681109536e-6, 1e-15);
}

TEST(Gravitation, IsGravityWithoutTheCentrifugalAcceleration) {
  // At the equator the centrifugal acceleration omega^2 (a + h) points up, so gravitation is stronger by it.
  const Geodetic position{0.0, 0.0, 0.0};
  const double centrifugal = 7.292115e-5 * 7.292115e-5 * 6378137.0;
  const Vector3 gravitation = Gravity().gravitation_e(position);
  EXPECT_NEAR(gravitation.x(), -(Gravity().g_n(position).z() + centrifugal), 1e-14);
  EXPECT_NEAR(gravitation.tail<2>().norm(), 0.0, 1e-14);
}

TEST(Gravitation, PointsToTheEarthsCentreButForTheFlattening) {
  // Gravitation's departure from the radius is about 3/2 J2 sin(2 lat) (J2 = 1.08e-3): 1.6e-3 rad at 45 deg, half of
  // what gravity itself departs (3.4e-3 = f sin(2 lat)); within second order, 1e-5.
  const Geodetic position{45.0 * kRadPerDeg, 0.3, 0.0};
  const Vector3 r_e = ecef_from_geodetic(position);
  const Vector3 gravitation = Gravity().gravitation_e(position);
  EXPECT_NEAR(gravitation.cross(r_e).norm() / (gravitation.norm() * r_e.norm()), 1.5 * 1.08263e-3, 1e-5);
}

}  // namespace
}  // namespace inslab::nav
