#include "inslab/models/air_data/pitot_lines.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"

namespace inslab::air_data {

double part_felt(const Vector3& v_b, double acceptance_angle_rad) {
  constexpr double kAbeam = 0.5 * units::kPi;
  const double angle_rad = std::atan2(std::hypot(v_b.y(), v_b.z()), v_b.x());
  if (angle_rad <= acceptance_angle_rad) return 1.0;
  if (angle_rad >= kAbeam) return 0.0;
  const double cosine = std::cos(kAbeam * (angle_rad - acceptance_angle_rad) / (kAbeam - acceptance_angle_rad));
  return cosine * cosine;
}

double PitotLines::pitot_pa(std::int64_t sim_time_ns, double mouth_pa, double outside_pa) {
  const bool drains = fault_.pitot_blocked && !fault_.pitot_drain_blocked;
  // The other end of the line is another pressure from one moment to the next.
  if (drains != drains_) pitot_.jump(drains ? outside_pa : mouth_pa);
  drains_ = drains;
  if (drains) return pitot_.follow(sim_time_ns, outside_pa, errors_.drain_time_constant_s);
  if (fault_.pitot_blocked) return pitot_.hold(sim_time_ns, mouth_pa);
  return pitot_.follow(sim_time_ns, mouth_pa, errors_.pitot_time_constant_s);
}

PitotLines::Pressures PitotLines::follow(std::int64_t sim_time_ns, const Airstream& stream, AirflowTruth& truth) {
  const double outside_pa = stream.air.pressure_pa;
  const double felt = part_felt(stream.v_ab_b_m_per_s, units::kDeg * errors_.acceptance_angle_deg);
  const double dynamic_pa = 0.5 * stream.air.density_kg_per_m3() * stream.airspeed_m_per_s * stream.airspeed_m_per_s;
  const double position_pa = errors_.static_pressure_coefficient * dynamic_pa;
  const double tube_pa = outside_pa + felt * stream.impact_pressure_pa;
  const double port_pa = outside_pa + position_pa;

  Pressures lines;
  lines.pitot_pa = pitot_pa(sim_time_ns, tube_pa, outside_pa);
  lines.static_pa = fault_.static_port_blocked ? static_.hold(sim_time_ns, port_pa)
                                               : static_.follow(sim_time_ns, port_pa, errors_.static_time_constant_s);

  truth.impact_pressure_error.probe = (felt - 1.0) * stream.impact_pressure_pa;
  truth.impact_pressure_error.position = -position_pa;
  truth.impact_pressure_error.line = (lines.pitot_pa - tube_pa) - (lines.static_pa - port_pa);
  truth.static_pressure_error.position = position_pa;
  truth.static_pressure_error.line = lines.static_pa - port_pa;
  return lines;
}

}  // namespace inslab::air_data
