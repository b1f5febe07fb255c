#pragma once

#include <cmath>

#include "inslab/models/satellites/orbit_constants.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::satellites {

/// The acceleration in e, m/s^2, of a free body: attraction of the Earth with its flattening, centrifugal and Coriolis
/// terms. Source: GLONASS ICD 5.1, appendix A.3.1.2, equations (1), without the pull of Moon and Sun.
inline nav::Vector3 turning_gravity(const nav::Vector3& r_e_m, const nav::Vector3& v_e_m_per_s,
                                    const OrbitConstants& earth) {
  const double r2 = r_e_m.squaredNorm();
  const double r = std::sqrt(r2);
  const double pull = earth.mu_m3_per_s2 / (r2 * r);
  const double flat = 1.5 * kPz90J2 * pull * kPz90Radius_m * kPz90Radius_m / r2;
  const double over_equator = 5.0 * r_e_m.z() * r_e_m.z() / r2;
  const double w = earth.omega_e_rad_per_s;
  const double across = -pull - flat * (1.0 - over_equator) + w * w;
  return {across * r_e_m.x() + 2.0 * w * v_e_m_per_s.y(), across * r_e_m.y() - 2.0 * w * v_e_m_per_s.x(),
          (-pull - flat * (3.0 - over_equator)) * r_e_m.z()};
}

}  // namespace inslab::satellites
