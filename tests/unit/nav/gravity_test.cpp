#include "inslab/nav/gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {
namespace gravity_test {

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
    EXPECT_NEAR(Gravity().g_n({row.latitude_deg * units::kDeg, 0.0, 0.0}).z(), -row.gamma_up_m_per_s2, 1e-9);
  }
}

TEST(Somigliana, FollowsTheExactFieldWithHeightToTheNextTermOfTheSeries) {
  // Bruns' formula gives the exact linear term, -(gamma (1/M + 1/N) + 2 omega^2) h; the closed form has it to first
  // order in f and m, and the quadratic term 3 x^2 without any: 9 f x^2 is left out there, and 4 x^3 is the next term.
  for (const Row& row : kAbove) {
    const double s = std::sin(row.latitude_deg * units::kDeg);
    const double x = row.height_m / wgs84::a_m;
    const double gamma = Gravity().normal_m_per_s2(s, 0.0);
    const double bruns =
        wgs84::a_m * (1.0 / wgs84::meridian_radius_from_sine_m(s) + 1.0 / wgs84::transverse_radius_from_sine_m(s) +
                      2.0 * wgs84::omega_e_rad_per_s * wgs84::omega_e_rad_per_s / gamma);
    const double closed = 2.0 * (1.0 + wgs84::f + 0.00344978650684 - 2.0 * wgs84::f * s * s);
    const double left_out =
        9.8 * (std::abs(bruns - closed) * std::abs(x) + 9.0 * wgs84::f * x * x + 4.0 * std::abs(x * x * x));
    EXPECT_NEAR(Gravity().g_n({row.latitude_deg * units::kDeg, 0.0, row.height_m}).z(), -row.gamma_up_m_per_s2,
                left_out + 1e-9)
        << row.latitude_deg << " deg, " << row.height_m << " m";
  }
}

// GeographicLib 2.1.2, NormalGravity::WGS84(), Gravity(lat, h): northward and upward, m/s^2.
struct FieldRow {
  double latitude_deg, height_m, north_m_per_s2, up_m_per_s2;
};
constexpr FieldRow kField[] = {{0, -100, 0, -9.78063412293594},
                               {15, -100, 4.0744698415196e-07, -9.78409371997246},
                               {30, -100, 7.05560642799696e-07, -9.79355594637608},
                               {45, -100, 8.14461659892629e-07, -9.80650633640924},
                               {60, -100, 7.05128335276584e-07, -9.81948540977602},
                               {75, -100, 4.07014677517026e-07, -9.82900500318672},
                               {90, -100, 0, -9.8324932838967},
                               {0, 0, 0, -9.78032533590389},
                               {15, 0, 0, -9.78378496235693},
                               {30, 0, 0, -9.79324726921932},
                               {45, 0, 0, -9.80619776937738},
                               {60, 0, 0, -9.81917695311863},
                               {75, 0, 0, -9.82869662748729},
                               {90, 0, 0, -9.8321849378634},
                               {0, 100, 0, -9.78001656340204},
                               {15, 100, -4.07437595661975e-07, -9.78347621926885},
                               {30, 100, -7.05544425549931e-07, -9.79293860658247},
                               {45, 100, -8.14443004593102e-07, -9.80588921685503},
                               {60, 100, -7.0511224059544e-07, -9.81886851096033},
                               {75, 100, -4.07005409375216e-07, -9.82838826627927},
                               {90, 100, 0, -9.83187660631865},
                               {0, 1000, 0, -9.7772382645939},
                               {15, 1000, -4.07395344748096e-06, -9.78069818506073},
                               {30, 1000, -7.05471446682537e-06, -9.79016129609585},
                               {45, 1000, -8.14359054412961e-06, -9.80311289693238},
                               {60, 1000, -7.0503981062231e-06, -9.81609318384411},
                               {75, 1000, -4.06963708554642e-06, -9.82561366736945},
                               {90, 1000, 0, -9.82910227425133},
                               {0, 10000, 0, -9.74951985825652},
                               {15, 10000, -4.06973021336299e-05, -9.7529824125311},
                               {30, 10000, -7.04741969963507e-05, -9.7624527273533},
                               {45, 10000, -8.13519889755199e-05, -9.77541418788896},
                               {60, 10000, -7.04315805348799e-05, -9.78840435660523},
                               {75, 10000, -4.06546856730472e-05, -9.79793208812852},
                               {90, 10000, 0, -9.80142335092358},
                               {0, 50000, 0, -9.62773287736573},
                               {15, 50000, -0.000202550084748676, -9.63120687663637},
                               {30, 50000, -0.000350753425085948, -9.64070849319438},
                               {45, 50000, -0.000404899039645912, -9.65371279179618},
                               {60, 50000, -0.000350552267506465, -9.66674588993931},
                               {75, 50000, -0.000202348927174079, -9.67630510591982},
                               {90, 50000, 0, -9.67980790507164}};

// What docs/models.md says that the short forms leave out.
TEST(NormalField, HasANorthPartThatTheShortFormsLeaveOut) {
  struct Case {
    double height_m, north_mgal, limit_mgal;
  };
  for (const Case& one : {Case{10e3, 8.1, 0.05}, Case{99e3, 80.0, 0.5}}) {
    const Geodetic place{45.0 * units::kDeg, 0.0, one.height_m};
    EXPECT_NEAR(std::abs(Gravity(GravityModel::Normal).g_n(place).x()) / units::kMGal, one.north_mgal, one.limit_mgal);
    for (const GravityModel model : {GravityModel::Somigliana, GravityModel::Series}) {
      EXPECT_EQ(Gravity(model).g_n(place).x(), 0.0);
    }
  }
}

TEST(NormalField, EqualsGeographicLibInBothHemispheres) {
  for (const FieldRow& row : kField) {
    for (const double hemisphere : {1.0, -1.0}) {
      const Vector3 g_n =
          Gravity(GravityModel::Normal).g_n({hemisphere * row.latitude_deg * units::kDeg, 0.0, row.height_m});
      EXPECT_NEAR(g_n.z(), -row.up_m_per_s2, 1e-9) << row.latitude_deg << " deg, " << row.height_m << " m";
      EXPECT_NEAR(g_n.x(), hemisphere * row.north_m_per_s2, 1e-9)
          << row.latitude_deg << " deg, " << row.height_m << " m";
      EXPECT_EQ(g_n.y(), 0.0);
    }
  }
}

/// Gravity of the same field by its zonal harmonics, in n: J2n = (-1)^(n+1) 3 e^2n/((2n+1)(2n+3)) (1 - n + 5 n J2/e2)
/// (Heiskanen and Moritz 2-92). The first left out, J12 of 2e-19 times the degree squared, is nothing.
Vector3 gravity_by_harmonics(double latitude_rad, double height_m) {
  using namespace wgs84;
  constexpr double J2 = 1.0826298213129e-3;  // of these constants: e2/3 (1 - 2/15 m e'/q0)
  const Vector3 r_e = ecef_from_geodetic({latitude_rad, 0.0, height_m});
  const double r = r_e.norm(), s = r_e.z() / r, c = r_e.x() / r;
  double radial = 1.0, northward = 0.0;
  double before = 1.0, legendre = s, before_slope = 0.0, slope = 1.0;  // P and its derivative, degrees 0 and 1
  for (int degree = 2; degree <= 10; ++degree) {
    const double next = ((2 * degree - 1) * s * legendre - (degree - 1) * before) / degree;
    const double next_slope = before_slope + (2 * degree - 1) * legendre;
    before = legendre, legendre = next, before_slope = slope, slope = next_slope;
    if (degree % 2 != 0) continue;
    const int n = degree / 2;
    const double J = (n % 2 == 0 ? -1.0 : 1.0) * 3.0 * std::pow(e2, n) / ((degree + 1.0) * (degree + 3.0)) *
                     (1.0 - n + 5.0 * n * J2 / e2);
    const double scale = J * std::pow(a_m / r, degree);
    radial -= (degree + 1) * scale * legendre;
    northward -= scale * slope * c;
  }
  const double attraction = gm_m3_per_s2 / (r * r), omega2 = omega_e_rad_per_s * omega_e_rad_per_s;
  const double up = -attraction * radial + omega2 * r * c * c;
  const double north = attraction * northward - omega2 * r * c * s;
  const double tilt = latitude_rad - std::atan2(s, c);  // geodetic less geocentric latitude
  return {std::cos(tilt) * north - std::sin(tilt) * up, 0.0, -(std::cos(tilt) * up + std::sin(tilt) * north)};
}

TEST(NormalField, EqualsItsHarmonicsOverTheWholeDomain) {
  for (double latitude_deg = -89.9; latitude_deg <= 89.9; latitude_deg += 4.495) {
    for (const double height_m : {-1000.0, 0.0, 3000.0, 30000.0, 70000.0, 100000.0}) {
      const Vector3 g_n = Gravity(GravityModel::Normal).g_n({latitude_deg * units::kDeg, 0.0, height_m});
      EXPECT_LT((g_n - gravity_by_harmonics(latitude_deg * units::kDeg, height_m)).norm(), 1e-9)
          << latitude_deg << " deg, " << height_m << " m";
    }
  }
}

TEST(Series, IsWithinAMilligalOfTheClosedForm) {
  // GRS80 and WGS-84 share the ellipsoid to 0.1 mm; the series stops at sin^4: 0.0000001262 sin^6 g = 1.2e-6 m/s^2, and
  // its printed constants are those of GRS80's rounding, a few 1e-6 m/s^2 in all.
  const Gravity series(GravityModel::Series);
  for (double latitude_deg = -90.0; latitude_deg <= 90.0; latitude_deg += 7.5) {
    for (const double height_m : {0.0, 1000.0, 10000.0}) {
      const Geodetic position{latitude_deg * units::kDeg, 0.0, height_m};
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
  const Geodetic position{45.0 * units::kDeg, 0.3, 0.0};
  const Vector3 r_e = ecef_from_geodetic(position);
  const Vector3 gravitation = Gravity().gravitation_e(position);
  EXPECT_NEAR(gravitation.cross(r_e).norm() / (gravitation.norm() * r_e.norm()), 1.5 * 1.08263e-3, 1e-5);
}

}  // namespace gravity_test
}  // namespace inslab::nav
