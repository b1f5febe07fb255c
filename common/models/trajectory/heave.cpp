#include "inslab/models/trajectory/heave.hpp"

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::trajectory {

Heave::Instant Heave::at(double t_s) const {
  const double rate = 2.0 * units::kPi / period_s;
  const double s = std::sin(rate * t_s), c = std::cos(rate * t_s);
  return {amplitude_m * s, amplitude_m * rate * c, -amplitude_m * rate * rate * s};
}

Heave heave_of(const scenario::VehicleAttitude& attitude) {
  if (attitude.vehicle_class != scenario::VehicleClass::Ship) return {};
  return {attitude.heave_amplitude_m, attitude.heave_period_s};
}

HeaveMotion heave_motion(const PathInstant& path, const Heave::Instant& heave) {
  using namespace nav::wgs84;
  const double s = std::sin(path.position.latitude_rad), c = std::cos(path.position.latitude_rad);
  const double h = path.position.height_m, h_rate = -path.v_n.z();
  const double M = meridian_radius_from_sine_m(s), N = transverse_radius_from_sine_m(s);
  const nav::Vector3 omega_en_n = nav::omega_en_n(path.position, path.v_n);
  // omega_en_n x d is how down turns: by lat' to the south and lon' cos lat to the west.
  const double to_south = path.v_n.x() / (M + h), to_west = path.v_n.y() / (N + h);
  const nav::Vector3 down_rate_n(-to_south, -to_west, 0.0);
  // dM/dlat = 3 M e^2 s c/(1 - e^2 s^2), dN/dlat a third of that over M, for N.
  const double radius_rate = e2 * s * c / (1.0 - e2 * s * s) * to_south;
  const nav::Vector3 v_rate_n = path.a_n - omega_en_n.cross(path.v_n);
  const nav::Vector3 down_rate_change_n((to_south * (3.0 * M * radius_rate + h_rate) - v_rate_n.x()) / (M + h),
                                        (to_west * (N * radius_rate + h_rate) - v_rate_n.y()) / (N + h), 0.0);
  const nav::Vector3 down_n = nav::Vector3::UnitZ();
  HeaveMotion motion;
  motion.v_n = -heave.up_m_per_s * down_n - heave.up_m * down_rate_n;
  motion.a_n = -heave.up_m_per_s2 * down_n - 2.0 * heave.up_m_per_s * down_rate_n -
               heave.up_m * (down_rate_change_n + omega_en_n.cross(down_rate_n));
  return motion;
}

}  // namespace inslab::trajectory
