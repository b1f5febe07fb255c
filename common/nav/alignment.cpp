#include "inslab/nav/alignment.hpp"

#include <cmath>
#include <optional>
#include <sstream>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

std::optional<std::string> moved(const StaticMeans& means, double gravity_m_per_s2, const AlignmentLimits& limits) {
  std::ostringstream why;
  if (!means.f_b.allFinite() || !means.omega_ib_b.allFinite() || !means.f_spread_b.allFinite()) {
    return "the means are not finite";
  }
  if (const double spread = means.f_spread_b.maxCoeff(); spread > limits.force_spread_m_per_s2) {
    why << "the specific force spreads by " << spread << " m/s^2, more than " << limits.force_spread_m_per_s2
        << ": the IMU was moving";
    return why.str();
  }
  if (std::abs(means.f_b.norm() - gravity_m_per_s2) > limits.force_from_gravity_m_per_s2) {
    why << "the mean specific force is " << means.f_b.norm() << " m/s^2 long, gravity " << gravity_m_per_s2
        << ": the IMU was moving or is not one in m/s^2";
    return why.str();
  }
  return std::nullopt;
}

}  // namespace

std::variant<Matrix3, std::string> coarse_alignment(const StaticMeans& means, double latitude_rad,
                                                    double gravity_m_per_s2, const AlignmentLimits& limits) {
  std::ostringstream why;
  if (!(90.0 - std::abs(latitude_rad) * units::kDegPerRad > limits.pole_distance_deg)) {
    why << "latitude " << latitude_rad * units::kDegPerRad << " deg is within " << limits.pole_distance_deg
        << " deg of a pole: gravity and the Earth's rate are parallel there";
    return why.str();
  }
  if (const auto reason = moved(means, gravity_m_per_s2, limits)) return *reason;
  const double rate = means.omega_ib_b.norm();
  if (std::abs(rate - wgs84::omega_e_rad_per_s) > limits.rate_ratio * wgs84::omega_e_rad_per_s) {
    why << "the mean rate is " << rate * units::kDegPerRad * 3600.0 << " deg/h, the Earth's "
        << wgs84::omega_e_rad_per_s * units::kDegPerRad * 3600.0 << ": the gyros' bias swamps it, or the IMU turned";
    return why.str();
  }
  const Vector3 down_b = -means.f_b.normalized();
  const Vector3 east_b = down_b.cross(means.omega_ib_b).normalized();
  if (!east_b.allFinite()) return std::string("the mean rate is parallel to the specific force");
  Matrix3 C_nb;
  C_nb.row(0) = east_b.cross(down_b);
  C_nb.row(1) = east_b;
  C_nb.row(2) = down_b;
  return C_nb;
}

std::variant<Matrix3, std::string> levelled(const StaticMeans& means, double yaw_rad, double gravity_m_per_s2,
                                            const AlignmentLimits& limits) {
  if (const auto reason = moved(means, gravity_m_per_s2, limits)) return *reason;
  const Vector3 down_b = -means.f_b.normalized();
  return matrix_from_rpy(
      {std::atan2(down_b.y(), down_b.z()), std::atan2(-down_b.x(), std::hypot(down_b.y(), down_b.z())), yaw_rad});
}

}  // namespace inslab::nav
