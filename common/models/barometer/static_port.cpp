#include "inslab/models/barometer/static_port.hpp"

#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::barometer {

namespace atmosphere = nav::standard_atmosphere;

atmosphere::Air StaticPort::air(const TruthState& truth, const Weather& drift) {
  constexpr double kPerHour = 1.0 / 3600.0;
  const std::int64_t now_ns = truth.header.sim_time_ns;
  const SensorSite site = sensor_site(truth, lever_arm_v_m_);
  const double sea_level_pa = errors_.sea_level_pressure_pa + drift.sea_level_pressure_pa +
                              errors_.sea_level_pressure_rate_pa_per_h * kPerHour * time::to_seconds(now_ns);
  atmosphere::Air air =
      atmosphere::air_at(atmosphere::geopotential_height_m(site.position.height_m - errors_.geoid_height_m),
                         sea_level_pa, errors_.temperature_deviation_deg_c + drift.temperature_k);
  const double dynamic_pa = 0.5 * air.density_kg_per_m3() * site.v_n.squaredNorm();
  const double port_pa = air.pressure_pa + errors_.static_pressure_coefficient * dynamic_pa;
  air.pressure_pa = lag_.follow(now_ns, port_pa, errors_.time_constant_s);
  return air;
}

}  // namespace inslab::barometer
