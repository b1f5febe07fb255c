#include "nav/gravity.hpp"

#include <cmath>

#include "nav/wgs84.hpp"

namespace inslab::nav {

namespace {

constexpr double kMPerS2PerMgal = 1e-5;
constexpr double kRadPerArcsec = 3.14159265358979323846 / 648000.0;

// NIMA TR8350.2, table 3.4: gravity at the equator, the formula's constant, and m = omega^2 a^2 b / GM.
constexpr double kEquator_m_per_s2 = 9.7803253359;
constexpr double kSomigliana = 0.00193185265241;
constexpr double kM = 0.00344978650684;

double somigliana(double sin2_latitude, double height_m) {
  using namespace wgs84;
  const double on_ellipsoid =
      kEquator_m_per_s2 * (1.0 + kSomigliana * sin2_latitude) / std::sqrt(1.0 - e2 * sin2_latitude);
  const double h_over_a = height_m / a_m;
  return on_ellipsoid * (1.0 + h_over_a * (-2.0 * (1.0 + f + kM - 2.0 * f * sin2_latitude) + 3.0 * h_over_a));
}

double series(double sin2_latitude, double height_m) {
  const double on_ellipsoid = 9.7803267715 * (1.0 + sin2_latitude * (0.0052790414 + 0.0000232718 * sin2_latitude));
  return on_ellipsoid + height_m * (-3.0876910891e-6 + 4.3977311e-9 * sin2_latitude + 7.211e-13 * height_m);
}

}  // namespace

Gravity::Gravity(GravityModel model, const Disturbance& disturbance)
    : model_(model),
      disturbance_m_per_s2_(disturbance.down_mgal * kMPerS2PerMgal),
      deflection_north_rad_(disturbance.deflection_north_arcsec * kRadPerArcsec),
      deflection_east_rad_(disturbance.deflection_east_arcsec * kRadPerArcsec) {}

double Gravity::normal_m_per_s2(double sin_latitude, double height_m) const {
  const double sin2 = sin_latitude * sin_latitude;
  return model_ == GravityModel::Somigliana ? somigliana(sin2, height_m) : series(sin2, height_m);
}

Vector3 Gravity::g_n(double sin_latitude, double height_m) const {
  const double g = normal_m_per_s2(sin_latitude, height_m) + disturbance_m_per_s2_;
  return {-g * deflection_north_rad_, -g * deflection_east_rad_, g};
}

Vector3 Gravity::g_n(const Geodetic& position) const { return g_n(std::sin(position.latitude_rad), position.height_m); }

Vector3 Gravity::gravitation_e(const Geodetic& position) const {
  const double s = std::sin(position.latitude_rad), c = std::cos(position.latitude_rad);
  const double s_lon = std::sin(position.longitude_rad), c_lon = std::cos(position.longitude_rad);
  const double from_axis_m = (wgs84::transverse_radius_from_sine_m(s) + position.height_m) * c;
  const double to_axis_m_per_s2 = wgs84::omega_e_rad_per_s * wgs84::omega_e_rad_per_s * from_axis_m;
  return C_en(s, c, s_lon, c_lon) * g_n(s, position.height_m) - to_axis_m_per_s2 * Vector3(c_lon, s_lon, 0.0);
}

}  // namespace inslab::nav
