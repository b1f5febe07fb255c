#include "inslab/models/gnss/constellation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::gnss {

namespace {

/// One orbital plane: its node, and the arguments of latitude of its satellites, at the constellation's epoch.
template <std::size_t N>
struct Plane {
  double node_deg;
  std::array<double, N> arguments_deg;
};

/// Circular orbits of one constellation.
struct Orbits {
  time::GpsTime epoch;
  double greenwich_deg;  ///< hour angle of Greenwich at the epoch
  double radius_m;
  double inclination_deg;
  double node_rate_rad_per_s;      ///< relative to the stars
  double argument_rate_rad_per_s;  ///< of latitude
};

constexpr std::array<Plane<4>, 6> kGpsPlanes{{{272.847, {268.126, 161.786, 11.676, 41.806}},
                                              {332.847, {80.956, 173.336, 309.976, 204.376}},
                                              {32.847, {111.876, 11.796, 339.666, 241.556}},
                                              {92.847, {135.226, 265.446, 35.156, 167.356}},
                                              {152.847, {197.046, 302.596, 66.066, 333.686}},
                                              {212.847, {238.886, 345.226, 105.206, 135.346}}}};
// 18 h 36 min 14.4 s, as the table gives it; 9 leap seconds since 1980.
constexpr Orbits kGps{{703, (4 * 86400 + 9) * 1'000'000'000LL}, 279.06, 26559.7e3, 55.0, 0.0,
                      2.0 * nav::wgs84::omega_e_rad_per_s};

// Slots 45 deg apart in a plane, planes 120 deg apart, 15 deg more of argument from plane to plane.
constexpr std::array<Plane<8>, 3> kGalileoPlanes{
    {{317.632, {0.153, 45.153, 90.153, 135.153, 180.153, 225.153, 270.153, 315.153}},
     {77.632, {15.153, 60.153, 105.153, 150.153, 195.153, 240.153, 285.153, 330.153}},
     {197.632, {30.153, 75.153, 120.153, 165.153, 210.153, 255.153, 300.153, 345.153}}}};
// Greenwich mean sidereal time of the epoch (IAU 1982); 17 leap seconds.
constexpr Orbits kGalileo{
    {1924, (86400 + 17) * 1'000'000'000LL}, 60.4264, 29599.8e3, 56.0, -0.02764398 * units::kDeg / 86400.0,
    613.72253566 * units::kDeg / 86400.0};

template <std::size_t Planes, std::size_t N>
void add_satellites(const Orbits& orbits, const std::array<Plane<N>, Planes>& planes, const time::GpsTime& time,
                    std::vector<Vector3>& satellites_e_m) {
  const double t_s = time::to_seconds(time - orbits.epoch);
  const double turned_rad = (orbits.node_rate_rad_per_s - nav::wgs84::omega_e_rad_per_s) * t_s;
  const double moved_rad = orbits.argument_rate_rad_per_s * t_s;
  const double cos_inclination = std::cos(orbits.inclination_deg * units::kDeg);
  const double sin_inclination = std::sin(orbits.inclination_deg * units::kDeg);
  for (const Plane<N>& plane : planes) {
    const double node_rad = (plane.node_deg - orbits.greenwich_deg) * units::kDeg + turned_rad;
    const double cos_node = std::cos(node_rad), sin_node = std::sin(node_rad);
    for (const double argument_deg : plane.arguments_deg) {
      const double argument_rad = argument_deg * units::kDeg + moved_rad;
      const double along = std::cos(argument_rad), across = std::sin(argument_rad) * cos_inclination;
      satellites_e_m.emplace_back(orbits.radius_m * (cos_node * along - sin_node * across),
                                  orbits.radius_m * (sin_node * along + cos_node * across),
                                  orbits.radius_m * std::sin(argument_rad) * sin_inclination);
    }
  }
}

}  // namespace

std::vector<Vector3> satellites_e_m(SatelliteModel model, const time::GpsTime& time) {
  std::vector<Vector3> satellites;
  satellites.reserve(48);
  if (model != SatelliteModel::Stated) add_satellites(kGps, kGpsPlanes, time, satellites);
  if (model == SatelliteModel::GpsGalileo) add_satellites(kGalileo, kGalileoPlanes, time, satellites);
  return satellites;
}

Geometry geometry_of(const nav::Geodetic& antenna, const std::vector<Vector3>& satellites_e_m, double mask_rad) {
  const Vector3 antenna_e_m = nav::ecef_from_geodetic(antenna);
  const Matrix3 C_ne = nav::C_en(antenna.latitude_rad, antenna.longitude_rad).transpose();
  const double sin_mask = std::sin(mask_rad);
  Geometry geometry;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  for (const Vector3& satellite_e_m : satellites_e_m) {
    const Vector3 sight_n = (C_ne * (satellite_e_m - antenna_e_m)).normalized();
    if (-sight_n.z() < sin_mask) continue;
    const Eigen::Vector4d row(sight_n.x(), sight_n.y(), sight_n.z(), 1.0);
    normal += row * row.transpose();
    ++geometry.satellites;
  }
  if (geometry.satellites < kFewestSatellites) return geometry;
  Eigen::Matrix4d cofactor;
  bool invertible = false;
  normal.computeInverseWithCheck(cofactor, invertible);
  const auto dop = [invertible](double square) {
    return invertible && square > 0.0 ? std::min(kMaxDop, std::sqrt(square)) : kMaxDop;
  };
  geometry.hdop = dop(cofactor(0, 0) + cofactor(1, 1));
  geometry.vdop = dop(cofactor(2, 2));
  return geometry;
}

}  // namespace inslab::gnss
