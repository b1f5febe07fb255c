#pragma once

#include <string>
#include <variant>

#include "inslab/nav/vectors.hpp"

namespace inslab::nav {

/// What an IMU at rest measured, over any span.
struct StaticMeans {
  Vector3 f_b = Vector3::Zero();         ///< mean specific force, m/s^2
  Vector3 omega_ib_b = Vector3::Zero();  ///< mean rate, rad/s
  Vector3 f_spread_b = Vector3::Zero();  ///< standard deviation of the specific force about its mean, m/s^2
};

/// Beyond these coarse alignment refuses.
struct AlignmentLimits {
  double pole_distance_deg = 1.0;            ///< nearer, gravity and the Earth's rate are parallel
  double rate_ratio = 0.5;                   ///< the mean rate's norm may be off the Earth's rate by this part of it
  double force_spread_m_per_s2 = 0.5;        ///< of any axis; more means that the IMU moved
  double force_from_gravity_m_per_s2 = 0.5;  ///< norm of the mean specific force less gravity
};

/// C_nb of an IMU at rest, or why there is none, in words. `gravity_m_per_s2` is the norm at the site. The attitude is
/// made orthogonal by the construction: down from the specific force, east from its cross product with the rate.
/// Source: the lab (11), (12).
std::variant<Matrix3, std::string> coarse_alignment(const StaticMeans& means, double latitude_rad,
                                                    double gravity_m_per_s2, const AlignmentLimits& limits);

/// C_nb whose roll and pitch level the specific force and whose yaw is `yaw_rad`; for IMUs that do not feel the Earth
/// turn. Refuses as coarse_alignment() does, but for what concerns the rate.
std::variant<Matrix3, std::string> levelled(const StaticMeans& means, double yaw_rad, double gravity_m_per_s2,
                                            const AlignmentLimits& limits);

}  // namespace inslab::nav
