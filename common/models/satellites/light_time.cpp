#include "inslab/models/satellites/light_time.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/data/broadcast/gnss_signal.hpp"

namespace inslab::satellites {

namespace {

constexpr double kC = broadcast::kSpeedOfLight_m_per_s;
constexpr double kEarthRate_rad_per_s = 7.2921151467e-5;  // of WGS 84 as IS-GPS-200 has it, table 20-IV

/// `vector` of the Earth's axes at transmission in those at reception, the Earth having turned by `turned_rad`.
Vector3 at_reception(const Vector3& vector, double turned_rad) {
  const double s = std::sin(turned_rad), c = std::cos(turned_rad);
  return {c * vector.x() + s * vector.y(), c * vector.y() - s * vector.x(), vector.z()};
}

}  // namespace

time::Nanoseconds usual_light_time(double radius_m) {
  constexpr double kBetween_m = 35e6;
  return radius_m < kBetween_m ? std::chrono::milliseconds(77) : std::chrono::milliseconds(125);
}

Sight sight(const Departure& departure, const AntennaState& antenna) {
  // Every step leaves v/c, 1e-5, of the error: 50 ms, 5e-7, 5e-12 and 5e-17 s.
  constexpr int kSteps = 4;
  const SatelliteState& from = departure.state;
  const double before_s = time::to_seconds(departure.before_reception);
  double tau_s = before_s, later_s = 0.0;
  Vector3 q_e_m = Vector3::Zero(), between_e_m = Vector3::Zero();
  for (int i = 0; i < kSteps; ++i) {
    later_s = antenna.rest_s + (before_s - tau_s);
    q_e_m = at_reception(from.r_e_m + later_s * (from.v_e_m_per_s + 0.5 * later_s * from.a_e_m_per_s2),
                         kEarthRate_rad_per_s * tau_s);
    between_e_m = q_e_m - antenna.r_e_m;
    tau_s = between_e_m.norm() / kC;
  }
  Sight sight;
  sight.light_time_s = tau_s;
  sight.line_e = between_e_m.normalized();
  const Vector3 q_rate = at_reception(from.v_e_m_per_s + later_s * from.a_e_m_per_s2, kEarthRate_rad_per_s * tau_s);
  const Vector3 turning = kEarthRate_rad_per_s * Vector3(q_e_m.y(), -q_e_m.x(), 0.0);
  sight.light_time_rate = sight.line_e.dot(q_rate - antenna.v_e_m_per_s) / (kC + sight.line_e.dot(q_rate - turning));
  sight.clock_s = from.clock_s + later_s * from.drift_s_per_s;
  sight.drift_s_per_s = from.drift_s_per_s;
  return sight;
}

AzimuthElevation direction_of(const Vector3& line_e, const Matrix3& C_en) {
  const Vector3 line_n = C_en.transpose() * line_e;
  return {std::atan2(line_n.y(), line_n.x()), std::asin(std::clamp(-line_n.z(), -1.0, 1.0))};
}

}  // namespace inslab::satellites
