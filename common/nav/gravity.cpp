#include "inslab/nav/gravity.hpp"

#include <cmath>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

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

/// The exact normal field at geodetic latitude and height, m/s^2: (north, down). Closed form in the ellipsoidal
/// coordinates u (semi-minor axis of the confocal ellipsoid through the point) and beta (reduced latitude).
/// Source: NIMA TR8350.2 (4-5)..(4-20); W. Heiskanen, H. Moritz, Physical Geodesy, 2-8 and 6-1.
struct NormalField {
  double north_m_per_s2;
  double down_m_per_s2;
};

NormalField normal_field(double sin_latitude, double height_m) {
  using namespace wgs84;
  const double s = sin_latitude, c = std::sqrt(1.0 - s * s);
  const double N = transverse_radius_from_sine_m(s);
  const double p = (N + height_m) * c, z = (N * (1.0 - e2) + height_m) * s;

  const double E2 = a_m * a_m - b_m * b_m, E = std::sqrt(E2);
  const double excess = p * p + z * z - E2;
  const double u2 = 0.5 * excess * (1.0 + std::sqrt(1.0 + 4.0 * E2 * z * z / (excess * excess)));
  const double u = std::sqrt(u2), v = std::sqrt(u2 + E2);
  const double beta = std::atan2(z * v, u * p);
  const double sb = std::sin(beta), cb = std::cos(beta);
  const double w = std::sqrt((u2 + E2 * sb * sb) / (u2 + E2));

  const auto q = [E](double radius) {
    const double ratio = radius / E;
    return 0.5 * ((1.0 + 3.0 * ratio * ratio) * std::atan2(E, radius) - 3.0 * ratio);
  };
  const double q0 = q(b_m);
  const double dq = 3.0 * (1.0 + u2 / E2) * (1.0 - u / E * std::atan2(E, u)) - 1.0;
  const double omega2 = omega_e_rad_per_s * omega_e_rad_per_s;
  const double gamma_u =
      -(gm_m3_per_s2 / (v * v) + omega2 * a_m * a_m * E / (v * v) * dq / q0 * (0.5 * sb * sb - 1.0 / 6.0) -
        omega2 * u * cb * cb) /
      w;
  const double gamma_beta = omega2 * (a_m * a_m / v * q(u) / q0 - v) * sb * cb / w;

  // Unit vectors along u and beta in the meridian plane: (away from the axis, along it).
  const double away = (gamma_u * u / v * cb - gamma_beta * sb) / w;
  const double along = (gamma_u * sb + gamma_beta * u / v * cb) / w;
  return {-s * away + c * along, -c * away - s * along};
}

}  // namespace

Gravity::Gravity(GravityModel model, const Disturbance& disturbance, std::shared_ptr<const GravityField> field,
                 std::shared_ptr<const GravityGrid> grid)
    : model_(model),
      disturbance_m_per_s2_(disturbance.down_mgal * units::kMGal),
      deflection_north_rad_(disturbance.deflection_north_arcsec * kRadPerArcsec),
      deflection_east_rad_(disturbance.deflection_east_arcsec * kRadPerArcsec),
      field_(std::move(field)),
      grid_(std::move(grid)) {}

bool Gravity::is_disturbed() const {
  return field_ || grid_ || disturbance_m_per_s2_ != 0.0 || deflection_north_rad_ != 0.0 || deflection_east_rad_ != 0.0;
}

double Gravity::normal_m_per_s2(double sin_latitude, double height_m) const {
  const double sin2 = sin_latitude * sin_latitude;
  switch (model_) {
    case GravityModel::Normal:
      return normal_field(sin_latitude, height_m).down_m_per_s2;
    case GravityModel::Series:
      return series(sin2, height_m);
    case GravityModel::Somigliana:
      break;
  }
  return somigliana(sin2, height_m);
}

Vector3 Gravity::uniform_g_n(double sin_latitude, double height_m) const {
  double north = 0.0, down = 0.0;
  if (model_ == GravityModel::Normal) {
    const NormalField field = normal_field(sin_latitude, height_m);
    north = field.north_m_per_s2;
    down = field.down_m_per_s2;
  } else {
    down = normal_m_per_s2(sin_latitude, height_m);
  }
  const double g = down + disturbance_m_per_s2_;
  return {north - g * deflection_north_rad_, -g * deflection_east_rad_, g};
}

Vector3 Gravity::varying_n(const Geodetic& position) const {
  Vector3 sum = Vector3::Zero();
  if (field_) sum += field_->disturbance_n(position, cell_);
  if (grid_) sum += grid_->disturbance_n(position);
  return sum;
}

Vector3 Gravity::g_n(const Geodetic& position) const {
  return g_n(std::sin(position.latitude_rad), position.height_m, [&position] { return position; });
}

Vector3 Gravity::gravitation_e(const Geodetic& position) const {
  const double s = std::sin(position.latitude_rad), c = std::cos(position.latitude_rad);
  const double s_lon = std::sin(position.longitude_rad), c_lon = std::cos(position.longitude_rad);
  const double from_axis_m = (wgs84::transverse_radius_from_sine_m(s) + position.height_m) * c;
  const double to_axis_m_per_s2 = wgs84::omega_e_rad_per_s * wgs84::omega_e_rad_per_s * from_axis_m;
  return C_en(s, c, s_lon, c_lon) * g_n(position) - to_axis_m_per_s2 * Vector3(c_lon, s_lon, 0.0);
}

}  // namespace inslab::nav
