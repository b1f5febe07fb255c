#pragma once

#include <cmath>
#include <functional>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/air_data/air_data_model.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

/// A probe, and truths to show it.
namespace inslab::air_data::scene {

constexpr std::int64_t kPeriodNs = 20000000;
constexpr double kPeriodS = 0.02;
constexpr double kLatitudeRad = 0.84;

/// Without errors, at 50 Hz, at the vehicle's reference point, in still standard air.
inline AirDataModel::Setup setup() {
  AirDataModel::Setup s{42, 0, time::Rate(50.0), {}, {}};
  s.installation.target.kind = SensorKind::AirData;
  return s;
}

/// A vehicle that does not turn against the Earth.
struct Flight {
  Vector3 v_n_m_per_s = Vector3(100.0, 0.0, 0.0);
  double roll_deg = 0.0;
  double pitch_deg = 0.0;
  double yaw_deg = 0.0;
  double height_m = 500.0;
  Vector3 omega_nv_v_rad_per_s = Vector3::Zero();
};

inline TruthState truth_at(std::uint64_t k, const Flight& flight = {}) {
  TruthState truth;
  truth.header.sim_time_ns = static_cast<std::int64_t>(k) * kPeriodNs;
  truth.interval_ns = kPeriodNs;
  truth.latitude_rad = kLatitudeRad;
  truth.longitude_rad = 0.2;
  truth.height_m = flight.height_m;
  truth.v_n = flight.v_n_m_per_s;
  truth.q_nv = nav::quaternion_from_rpy(
      {flight.roll_deg * units::kDeg, flight.pitch_deg * units::kDeg, flight.yaw_deg * units::kDeg});
  const Vector3 omega_ie_n =
      nav::wgs84::omega_e_rad_per_s * Vector3(std::cos(kLatitudeRad), 0.0, -std::sin(kLatitudeRad));
  truth.omega_iv_v = truth.q_nv.conjugate() * omega_ie_n + flight.omega_nv_v_rad_per_s;
  return truth;
}

inline FaultProfile fault(const std::function<void(FaultProfile&)>& change) {
  FaultProfile profile;
  profile.target.kind = SensorKind::AirData;
  change(profile);
  return profile;
}

inline nav::standard_atmosphere::Air air_over(double height_m) {
  return nav::standard_atmosphere::air_at(nav::standard_atmosphere::geopotential_height_m(height_m));
}

/// q_c of the definition, subsonic.
inline double impact_pa(double height_m, double airspeed_m_per_s) {
  const auto air = air_over(height_m);
  const double m2 = airspeed_m_per_s * airspeed_m_per_s / (1.4 * 287.05287 * air.temperature_k);
  return air.pressure_pa * (std::pow(1.0 + 0.2 * m2, 3.5) - 1.0);
}

}  // namespace inslab::air_data::scene
