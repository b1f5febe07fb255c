#pragma once

#include <algorithm>
#include <cmath>

#include "inslab/data/profiles/odometer_error_profile.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/odometer/wheel_contact.hpp"

/// What of the way a wheel turns, before scale factor, noise and counts.
namespace inslab::odometer {

/// Slip: by which part the wheel turns more than it rolls. None up to the thresholds, then in proportion; driven (force
/// and way in one direction) it spins, braked it drags, at most standing still. The straight first part of the tyre's
/// curve, as in H. Pacejka, Tire and Vehicle Dynamics, 3rd ed. (2012), 1.2.
inline double slip(const Rolled& rolled, const OdometerErrorProfile& errors) {
  const double along = std::abs(rolled.force_along_m_s2) - errors.longitudinal_slip_threshold_m_per_s2;
  const double across = std::abs(rolled.force_across_m_s2) - errors.lateral_slip_threshold_m_per_s2;
  const double size = std::min(1.0, errors.longitudinal_slip_s2_per_m * std::max(0.0, along) +
                                        errors.lateral_slip_s2_per_m * std::max(0.0, across));
  return rolled.force_along_m_s2 * rolled.along_m < 0.0 ? -size : size;
}

/// The way that a wheel of true size turns in an interval of the truth, m: with slip, nothing when too slow, forwards
/// alone where the direction is not known.
inline double turned_m(const Rolled& rolled, const OdometerErrorProfile& errors) {
  if (std::abs(rolled.along_m) < errors.dead_below_m_per_s * rolled.dt_s) return 0.0;
  const double turned = rolled.along_m * (1.0 + slip(rolled, errors));
  return errors.direction_known ? turned : std::abs(turned);
}

/// The part of the scale factor that is not random, as a factor less 1, at a sim time.
inline double known_scale(const OdometerErrorProfile& errors, std::int64_t sim_time_ns) {
  const double warm = -std::expm1(-time::to_seconds(sim_time_ns) / errors.tyre_warming_time_s);
  return units::kPpm * (errors.scale_factor_ppm + errors.tyre_warming_ppm * warm);
}

}  // namespace inslab::odometer
