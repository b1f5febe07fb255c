#include "inslab/models/gnss/constellation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/nominal_slots.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::gnss {

namespace {

void add_satellites(const satellites::SlotFamily& family, const time::GpsTime& time,
                    std::vector<Vector3>& positions_e_m) {
  const satellites::SlotOrbits& orbits = family.orbits;
  const double t_s = time::to_seconds(time - orbits.epoch);
  const double turned_rad = (orbits.node_rate_rad_per_s - nav::wgs84::omega_e_rad_per_s) * t_s;
  const double moved_rad = orbits.argument_rate_rad_per_s * t_s;
  const double cos_inclination = std::cos(orbits.inclination_deg * units::kDeg);
  const double sin_inclination = std::sin(orbits.inclination_deg * units::kDeg);
  for (const satellites::Slot& slot : family.slots) {
    const double node_rad = (slot.node_deg - orbits.greenwich_deg) * units::kDeg + turned_rad;
    const double cos_node = std::cos(node_rad), sin_node = std::sin(node_rad);
    const double argument_rad = slot.argument_deg * units::kDeg + moved_rad;
    const double along = std::cos(argument_rad), across = std::sin(argument_rad) * cos_inclination;
    positions_e_m.emplace_back(orbits.radius_m * (cos_node * along - sin_node * across),
                               orbits.radius_m * (sin_node * along + cos_node * across),
                               orbits.radius_m * std::sin(argument_rad) * sin_inclination);
  }
}

}  // namespace

std::vector<Vector3> satellites_e_m(SatelliteModel model, const time::GpsTime& time) {
  const std::vector<satellites::SlotFamily>& families = satellites::nominal_slots();  // GPS, Galileo, ...
  std::vector<Vector3> positions_e_m;
  positions_e_m.reserve(48);
  if (model != SatelliteModel::Stated) add_satellites(families[0], time, positions_e_m);
  if (model == SatelliteModel::GpsGalileo) add_satellites(families[1], time, positions_e_m);
  return positions_e_m;
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
