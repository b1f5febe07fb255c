#pragma once

#include <cmath>
#include <vector>

#include "inslab/data/samples/air_pressure.hpp"
#include "inslab/models/navigation/measurement.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/standard_atmosphere.hpp"

namespace inslab::navigation {

/// The height that a barometer's pressure has in the standard atmosphere (ISO 2533):
///
///   H_p = (1 + k) H(h) - T dh/dt - K v^2 / (2 g) + b
///
/// h and v of the port over ellipsoid and ground, H its geopotential height. b: pressure at sea level, geoid, offset.
/// k: the hydrostatic equation, dp/dH = -p g / (R T), makes dH_p/dH the standard's temperature over the air's. K: a
/// share of the dynamic pressure, rho v^2 / 2, which is v^2 / (2 g) of height at any density. T: the lag, to its first
/// order.
struct PressureAltitude {
  using Sample = AirPressure;
  static constexpr std::string_view name = "pressure_altitude";

  static bool usable(const AirPressure& sample) {
    return std::isfinite(sample.pressure_altitude_m) && !sample.saturated;
  }

  static void add_to(std::vector<Measurement>& measurements, const AirPressure& sample, const Situation& at,
                     const NavigationParameters& p) {
    namespace air = nav::standard_atmosphere;
    const BarometerBelief& barometer = p.barometer;
    const nav::Vector3 arm_n = at.C_nb * barometer.lever_arm_b_m;
    const nav::Vector3 omega_ie_n = nav::omega_ie_n(at.position.latitude_rad);
    const nav::Vector3 turning_n = at.C_nb * at.omega_ib_b.cross(barometer.lever_arm_b_m);
    const nav::Vector3 v_n = at.v_n + turning_n - omega_ie_n.cross(arm_n);
    const double height_m = at.position.height_m - arm_n.z();
    const double geopotential_m = air::geopotential_height_m(height_m);
    const double per_height = std::pow(air::kEarthRadiusM / (air::kEarthRadiusM + height_m), 2);
    const double by_height = 1.0 + at.estimates[StateBlock::PressureSlope][0];
    const double static_pressure = at.estimates[StateBlock::PressureSlope][1];
    const double dynamic_m = v_n.squaredNorm() / (2.0 * air::kGMPerS2);
    const double metres_per_pa = 1.0 / (air::air_at(sample.pressure_altitude_m).density_kg_per_m3() * air::kGMPerS2);

    Measurement& m = measurements.emplace_back();
    m.name = name;
    m.gate = p.innovation_test.limit;
    m.innovation.resize(1);
    m.innovation[0] = by_height * geopotential_m + barometer.lag_s * v_n.z() - static_pressure * dynamic_m +
                      at.estimates[StateBlock::PressureBias].sum() - sample.pressure_altitude_m;
    m.R.resize(1);
    m.R[0] = std::pow(metres_per_pa * barometer.white_sigma_pa, 2);
    const nav::Vector3 by_velocity = barometer.lag_s * nav::Vector3::UnitZ() - static_pressure / air::kGMPerS2 * v_n;
    m.by(StateBlock::Position, nav::Vector3(0.0, 0.0, -by_height * per_height).transpose());
    m.by(StateBlock::Velocity, by_velocity.transpose());
    m.by(StateBlock::Attitude,
         -by_height * per_height * nav::skew(arm_n).row(2) +
             by_velocity.transpose() * (nav::skew(turning_n) - nav::skew(omega_ie_n) * nav::skew(arm_n)));
    m.by(StateBlock::PressureBias, nav::Vector3::Ones().transpose());
    m.by(StateBlock::PressureSlope, Eigen::RowVector2d(geopotential_m, -dynamic_m));
  }
};

}  // namespace inslab::navigation
