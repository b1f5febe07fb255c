#include "inslab/nav/geodesy.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

/// How a point of a meridian plane moves, in m: away from the axis and along it, when its latitude changes by
/// `dlatitude_rad` and its height by `dheight_m`. Differences of sines are written as products, so that a small change
/// keeps all its digits. beta is the reduced latitude, tan(beta) = (1 - f) tan(latitude).
struct MeridianMove {
  double from_axis_m;
  double along_axis_m;
};
MeridianMove meridian_move(double latitude_rad, double height_m, double dlatitude_rad, double dheight_m) {
  using namespace wgs84;
  const double end_rad = latitude_rad + dlatitude_rad;
  const double middle_rad = latitude_rad + 0.5 * dlatitude_rad;
  const double s = std::sin(latitude_rad), c = std::cos(latitude_rad);
  const double s_end = std::sin(end_rad), c_end = std::cos(end_rad);
  const double beta = std::atan2((1.0 - f) * s, c);
  const double dbeta = std::atan2((1.0 - f) * std::sin(dlatitude_rad), c * c_end + (1.0 - f) * (1.0 - f) * s * s_end);
  const double beta_middle = beta + 0.5 * dbeta;
  const double chord_beta = 2.0 * std::sin(0.5 * dbeta);
  const double chord = 2.0 * std::sin(0.5 * dlatitude_rad);
  return {-a_m * std::sin(beta_middle) * chord_beta - height_m * std::sin(middle_rad) * chord + dheight_m * c_end,
          b_m * std::cos(beta_middle) * chord_beta + height_m * std::cos(middle_rad) * chord + dheight_m * s_end};
}

std::string out_of_domain(const char* quantity, double value, const char* unit, double low, double high) {
  std::ostringstream text;
  text.precision(10);
  text << quantity << " is " << value << ' ' << unit << ", outside the valid domain of " << low << " to " << high << ' '
       << unit;
  return text.str();
}

// A double holds a coordinate to 5e-10 m. Both ways are computed in extended precision, or the arithmetic's own
// roundings would add up to 3e-9 m.
using Real = long double;
constexpr Real kA = 6378137.0L;
constexpr Real kF = 1.0L / 298.257223563L;
constexpr Real kE2 = kF * (2.0L - kF);

}  // namespace

bool in_domain(const Geodetic& position) {
  return std::abs(position.latitude_rad) <= kMaxLatitudeDeg * units::kDeg && position.height_m >= kMinHeightM &&
         position.height_m <= kMaxHeightM && std::isfinite(position.longitude_rad);
}

void check_domain(const Geodetic& position) {
  if (in_domain(position)) return;
  if (!(std::abs(position.latitude_rad) <= kMaxLatitudeDeg * units::kDeg)) {
    throw std::domain_error(
        out_of_domain("latitude", position.latitude_rad / units::kDeg, "deg", -kMaxLatitudeDeg, kMaxLatitudeDeg));
  }
  if (!std::isfinite(position.longitude_rad)) throw std::domain_error("longitude is not a finite number");
  throw std::domain_error(out_of_domain("height", position.height_m, "m", kMinHeightM, kMaxHeightM));
}

Vector3 ecef_from_geodetic(const Geodetic& position) {
  const Real latitude = position.latitude_rad, longitude = position.longitude_rad, h = position.height_m;
  const Real s = std::sin(latitude), c = std::cos(latitude);
  const Real N = kA / std::sqrt(1.0L - kE2 * s * s);
  const Real from_axis = (N + h) * c;
  return {static_cast<double>(from_axis * std::cos(longitude)), static_cast<double>(from_axis * std::sin(longitude)),
          static_cast<double>((N * (1.0L - kE2) + h) * s)};
}

Geodetic geodetic_from_ecef(const Vector3& r_e_m) {
  const Real x = r_e_m.x(), y = r_e_m.y(), z = r_e_m.z();
  const Real p = std::sqrt(x * x + y * y);
  // Above 6.25e6 m from the centre Bowring's formula is a good start and Newton's steps contract.
  const Real r = std::sqrt(p * p + z * z);
  if (!(r > 6.25e6L) || !std::isfinite(r)) {
    throw std::domain_error("a point " + std::to_string(r) + " m from the Earth's centre is too deep for a latitude");
  }
  const Real beta = std::atan2(z, (1.0L - kF) * p);
  const Real sb = std::sin(beta), cb = std::cos(beta);
  Real latitude = std::atan2(z + kE2 / (1.0L - kF) * kA * sb * sb * sb, p - kE2 * kA * cb * cb * cb);
  Real height = 0.0L;
  for (int step = 0; step < 3; ++step) {
    const Real s = std::sin(latitude), c = std::cos(latitude);
    const Real w2 = 1.0L - kE2 * s * s;
    const Real N = kA / std::sqrt(w2), M = N * (1.0L - kE2) / w2;
    const Real dp = p - N * c;
    const Real dz = z - N * (1.0L - kE2) * s;
    height = dp * c + dz * s;
    latitude += (dz * c - dp * s) / (M + height);
  }
  return {static_cast<double>(latitude), p > 0.0L ? static_cast<double>(std::atan2(y, x)) : 0.0,
          static_cast<double>(height)};
}

Matrix3 C_en(double sin_latitude, double cos_latitude, double sin_longitude, double cos_longitude) {
  Matrix3 C;
  C << -sin_latitude * cos_longitude, -sin_longitude, -cos_latitude * cos_longitude,  //
      -sin_latitude * sin_longitude, cos_longitude, -cos_latitude * sin_longitude,    //
      cos_latitude, 0.0, -sin_latitude;
  return C;
}

Matrix3 C_en(double latitude_rad, double longitude_rad) {
  return C_en(std::sin(latitude_rad), std::cos(latitude_rad), std::sin(longitude_rad), std::cos(longitude_rad));
}

Geodetic geodetic_change(const Geodetic& origin, const Vector3& ned_m) {
  const double s = std::sin(origin.latitude_rad), c = std::cos(origin.latitude_rad);
  const double p = (wgs84::transverse_radius_from_sine_m(s) + origin.height_m) * c;
  // In the meridian plane of the origin: x away from the axis, z along it; y is east.
  const double dx = -s * ned_m.x() - c * ned_m.z();
  const double dz = c * ned_m.x() - s * ned_m.z();
  const double y = ned_m.y();
  const double p_end = std::hypot(p + dx, y);
  const double dp = dx + y * y / (p_end + (p + dx));  // p_end - p without the difference of the two
  double dlatitude = 0.0, dheight = 0.0;
  for (int step = 0; step < 6; ++step) {
    const MeridianMove move = meridian_move(origin.latitude_rad, origin.height_m, dlatitude, dheight);
    const double missing_p = dp - move.from_axis_m, missing_z = dz - move.along_axis_m;
    const double s_end = std::sin(origin.latitude_rad + dlatitude), c_end = std::cos(origin.latitude_rad + dlatitude);
    dlatitude += (missing_z * c_end - missing_p * s_end) /
                 (wgs84::meridian_radius_from_sine_m(s_end) + origin.height_m + dheight);
    dheight += missing_p * c_end + missing_z * s_end;
    // What a Newton step leaves is about its square over the Earth's radius: below 1e-15 of the line, this was the
    // last.
    if (missing_p * missing_p + missing_z * missing_z < 1e-15 * wgs84::a_m * ned_m.norm()) break;
  }
  return {dlatitude, std::atan2(y, p + dx), dheight};
}

Geodetic displaced(const Geodetic& origin, const Vector3& ned_m) {
  const Geodetic change = geodetic_change(origin, ned_m);
  return {origin.latitude_rad + change.latitude_rad, wrapped_to_pi(origin.longitude_rad + change.longitude_rad),
          origin.height_m + change.height_m};
}

Vector3 ned_from(const Geodetic& origin, const Geodetic& point) {
  const double s = std::sin(origin.latitude_rad), c = std::cos(origin.latitude_rad);
  const MeridianMove move = meridian_move(origin.latitude_rad, origin.height_m,
                                          point.latitude_rad - origin.latitude_rad, point.height_m - origin.height_m);
  const double p_end = (wgs84::transverse_radius_m(point.latitude_rad) + point.height_m) * std::cos(point.latitude_rad);
  const double dlongitude = wrapped_to_pi(point.longitude_rad - origin.longitude_rad);
  const double half = std::sin(0.5 * dlongitude);
  const double dx = move.from_axis_m - 2.0 * p_end * half * half;
  return {-s * dx + c * move.along_axis_m, p_end * std::sin(dlongitude), -c * dx - s * move.along_axis_m};
}

Vector3 omega_ie_n(double latitude_rad) {
  return {wgs84::omega_e_rad_per_s * std::cos(latitude_rad), 0.0, -wgs84::omega_e_rad_per_s * std::sin(latitude_rad)};
}

Vector3 omega_en_n(const Geodetic& position, const Vector3& v_n) {
  const double s = std::sin(position.latitude_rad);
  const double M = wgs84::meridian_radius_from_sine_m(s);
  const double N = wgs84::transverse_radius_from_sine_m(s);
  const double east = v_n.y() / (N + position.height_m);
  return {east, -v_n.x() / (M + position.height_m), -east * std::tan(position.latitude_rad)};
}

double wrapped_to_pi(double angle_rad) {
  if (std::abs(angle_rad) <= units::kPi) return angle_rad;
  return std::remainder(angle_rad, 2.0 * units::kPi);
}

}  // namespace inslab::nav
