#include "inslab/models/air_data/airstream.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/air_data/mean_wind.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/compressible_flow.hpp"

namespace inslab::air_data {

namespace atmosphere = nav::standard_atmosphere;
namespace flow = nav::compressible_flow;

void AirOnTheWay::use(const AirDataErrorProfile& profile) {
  air_ = profile.air;
  wind_ = profile.wind;
  sea_level_drift_.retune({air_.sea_level_pressure_gm_sigma_pa, air_.sea_level_pressure_gm_correlation_time_s});
  temperature_drift_.retune(
      {air_.temperature_deviation_gm_sigma_deg_c, air_.temperature_deviation_gm_correlation_time_s});
}

void AirOnTheWay::use(const InstallationProfile& installation) {
  const Vector3 mounting_rad = units::kDeg * installation.mounting_rpy_deg;
  C_bv_ = nav::matrix_from_rpy({mounting_rad.x(), mounting_rad.y(), mounting_rad.z()}).transpose();
  lever_arm_v_m_ = installation.lever_arm_v_m;
}

atmosphere::Air AirOnTheWay::air_at(std::uint64_t k, double height_m, std::int64_t sim_time_ns) {
  constexpr double kPerHour = 1.0 / 3600.0;
  const double sea_level_pa = air_.sea_level_pressure_pa + sea_level_drift_.advance(k - 1) +
                              air_.sea_level_pressure_rate_pa_per_h * kPerHour * time::to_seconds(sim_time_ns);
  const double deviation_k = air_.temperature_deviation_deg_c + temperature_drift_.advance(k - 1);
  return atmosphere::air_at(atmosphere::geopotential_height_m(height_m - air_.geoid_height_m), sea_level_pa,
                            deviation_k);
}

/// The axes of the gusts follow the mean wind over the ground; where there is none they are north, east, down.
Vector3 AirOnTheWay::gust_ned_m_per_s(std::uint64_t k, const TruthState& truth) {
  const double height_m = truth.height_m - wind_.ground_height_m;
  const Vector3 mean_n = mean_wind_ned_m_per_s(wind_, height_m);
  const Vector3 gust = gusts_.advance(k, wind_, height_m, period_s_ * (truth.v_n - mean_n).norm());
  const double level = std::hypot(mean_n.x(), mean_n.y());
  if (level == 0.0) return gust;
  const double north = mean_n.x() / level, east = mean_n.y() / level;
  return {north * gust.x() - east * gust.y(), east * gust.x() + north * gust.y(), gust.z()};
}

Airstream AirOnTheWay::at(std::uint64_t k, const TruthState& truth) {
  const SensorSite site = sensor_site(truth, lever_arm_v_m_);
  Airstream stream;
  stream.air = air_at(k, site.position.height_m, truth.header.sim_time_ns);
  stream.gust_ned_m_per_s = gust_ned_m_per_s(k, truth);
  stream.wind_ned_m_per_s =
      mean_wind_ned_m_per_s(wind_, site.position.height_m - wind_.ground_height_m) + stream.gust_ned_m_per_s;
  const Vector3 v_as_s = site.v_n - stream.wind_ned_m_per_s;
  stream.v_ab_b_m_per_s = C_bv_ * (truth.q_nv.conjugate() * (site.C_sn.transpose() * v_as_s));
  stream.airspeed_m_per_s = stream.v_ab_b_m_per_s.norm();
  stream.mach = stream.airspeed_m_per_s / flow::speed_of_sound_m_per_s(stream.air.temperature_k);
  stream.impact_pressure_pa = stream.air.pressure_pa * flow::impact_ratio(stream.mach);
  if (stream.airspeed_m_per_s > 0.0) {
    stream.angle_of_attack_rad = std::atan2(stream.v_ab_b_m_per_s.z(), stream.v_ab_b_m_per_s.x());
    stream.angle_of_sideslip_rad =
        std::asin(std::clamp(stream.v_ab_b_m_per_s.y() / stream.airspeed_m_per_s, -1.0, 1.0));
  }
  return stream;
}

}  // namespace inslab::air_data
