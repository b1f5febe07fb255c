#include "inslab/models/satellites/kepler_orbit.hpp"

#include <cmath>

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/data/broadcast/system_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/orbit_plane.hpp"
#include "inslab/models/satellites/turning_gravity.hpp"

namespace inslab::satellites {

namespace {

/// A point in the plane of the orbit, x towards the node, and its inclination: with their derivatives.
struct InPlane {
  double x_m, y_m, vx_m_per_s, vy_m_per_s;
  double inclination_rad, inclination_rate_rad_per_s;
};

/// Where in its orbit: the eccentric anomaly with its rate.
struct Anomaly {
  double eccentric_rad, rate_rad_per_s;
};

Anomaly anomaly_at(const KeplerianEphemeris& e, double tk_s) {
  const double n = mean_motion_rad_per_s(e);
  const double eccentric_rad = eccentric_anomaly_rad(e.m0_rad + n * tk_s, e.eccentricity);
  return {eccentric_rad, n / (1.0 - e.eccentricity * std::cos(eccentric_rad))};
}

InPlane in_plane(const KeplerianEphemeris& e, const Anomaly& anomaly, double tk_s) {
  const double sin_e = std::sin(anomaly.eccentric_rad), cos_e = std::cos(anomaly.eccentric_rad);
  const double root = std::sqrt(1.0 - e.eccentricity * e.eccentricity);
  const double a_m = e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m;
  const double true_anomaly = std::atan2(root * sin_e, cos_e - e.eccentricity);
  const double rate = anomaly.rate_rad_per_s * root / (1.0 - e.eccentricity * cos_e);  // of true anomaly and latitude

  const double phi = true_anomaly + e.argument_of_perigee_rad;
  const double s2 = std::sin(2.0 * phi), c2 = std::cos(2.0 * phi);
  const double u = phi + e.cus_rad * s2 + e.cuc_rad * c2;
  const double u_rate = rate * (1.0 + 2.0 * (e.cus_rad * c2 - e.cuc_rad * s2));
  const double r = a_m * (1.0 - e.eccentricity * cos_e) + e.crs_m * s2 + e.crc_m * c2;
  const double r_rate =
      a_m * e.eccentricity * sin_e * anomaly.rate_rad_per_s + 2.0 * rate * (e.crs_m * c2 - e.crc_m * s2);

  const double sin_u = std::sin(u), cos_u = std::cos(u);
  return {r * cos_u,
          r * sin_u,
          r_rate * cos_u - r * sin_u * u_rate,
          r_rate * sin_u + r * cos_u * u_rate,
          e.i0_rad + e.i_dot_rad_per_s * tk_s + e.cis_rad * s2 + e.cic_rad * c2,
          e.i_dot_rad_per_s + 2.0 * rate * (e.cis_rad * c2 - e.cic_rad * s2)};
}

/// Out of the plane into axes in which its node has a longitude and a rate.
void place(const InPlane& p, double node_rad, double node_rate, SatelliteState& state) {
  const double sin_o = std::sin(node_rad), cos_o = std::cos(node_rad);
  const double sin_i = std::sin(p.inclination_rad), cos_i = std::cos(p.inclination_rad);
  const double across = p.y_m * cos_i;
  const double across_rate = p.vy_m_per_s * cos_i - p.y_m * sin_i * p.inclination_rate_rad_per_s;
  Vector3& r = state.r_e_m;
  r = {p.x_m * cos_o - across * sin_o, p.x_m * sin_o + across * cos_o, p.y_m * sin_i};
  state.v_e_m_per_s = {p.vx_m_per_s * cos_o - across_rate * sin_o - node_rate * r.y(),
                       p.vx_m_per_s * sin_o + across_rate * cos_o + node_rate * r.x(),
                       p.vy_m_per_s * sin_i + p.y_m * cos_i * p.inclination_rate_rad_per_s};
}

/// The orbit of a geostationary satellite, given askew in axes that do not turn, in e.
void turn_geostationary(double turned_rad, double rate, SatelliteState& state) {
  const Matrix3 C_ek = rotation_z(turned_rad) * rotation_x(-geostationary_tilt_rad());
  state.r_e_m = C_ek * state.r_e_m;
  const Vector3 of_rotation(rate * state.r_e_m.y(), -rate * state.r_e_m.x(), 0.0);
  state.v_e_m_per_s = C_ek * state.v_e_m_per_s + of_rotation;
}

void set_clock(const KeplerianEphemeris& e, const Anomaly& anomaly, double mu, const time::GpsTime& gps,
               SatelliteState& state) {
  constexpr double kC = broadcast::kSpeedOfLight_m_per_s;
  const double tc_s = time::to_seconds(gps - e.toc);
  const double relativity_s = -2.0 * std::sqrt(mu) / (kC * kC) * e.eccentricity * e.sqrt_a_sqrt_m;
  state.clock_s =
      e.af0_s + tc_s * (e.af1_s_per_s + tc_s * e.af2_s_per_s2) + relativity_s * std::sin(anomaly.eccentric_rad);
  state.drift_s_per_s = e.af1_s_per_s + 2.0 * tc_s * e.af2_s_per_s2 +
                        relativity_s * std::cos(anomaly.eccentric_rad) * anomaly.rate_rad_per_s;
}

}  // namespace

double eccentric_anomaly_rad(double mean_anomaly_rad, double eccentricity) {
  constexpr double kTolerance_rad = 1e-14;
  constexpr int kMostSteps = 20;
  // Of many turns only the last counts; what is left of them would be the rounding of a large number.
  const double m = std::remainder(mean_anomaly_rad, 2.0 * units::kPi);
  double e = eccentricity < 0.8 ? m : std::copysign(units::kPi, m);
  for (int i = 0; i < kMostSteps; ++i) {
    const double step = (e - eccentricity * std::sin(e) - m) / (1.0 - eccentricity * std::cos(e));
    e -= step;
    if (std::abs(step) <= kTolerance_rad) break;
  }
  return e;
}

double mean_motion_rad_per_s(const KeplerianEphemeris& e) {
  const double a_m = e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m;
  return std::sqrt(orbit_constants(e.satellite.system).mu_m3_per_s2 / (a_m * a_m * a_m)) + e.delta_n_rad_per_s;
}

double geostationary_tilt_rad() { return 5.0 * units::kDeg; }

SatelliteState kepler_state(const KeplerianEphemeris& e, const time::GpsTime& gps) {
  const OrbitConstants earth = orbit_constants(e.satellite.system);
  const double w = earth.omega_e_rad_per_s;
  const double tk_s = time::to_seconds(gps - e.toe);
  const double toes_s = time::to_seconds(broadcast::time_of_week_ns(e.satellite.system, e.toe));
  const bool is_geostationary = is_beidou_geostationary(e.satellite);
  const double node_rate = e.omega_dot_rad_per_s - (is_geostationary ? 0.0 : w);
  const Anomaly anomaly = anomaly_at(e, tk_s);

  SatelliteState state;
  place(in_plane(e, anomaly, tk_s), std::remainder(e.omega0_rad - w * toes_s, 2.0 * units::kPi) + node_rate * tk_s,
        node_rate, state);
  if (is_geostationary) turn_geostationary(w * tk_s, w, state);
  state.a_e_m_per_s2 = turning_gravity(state.r_e_m, state.v_e_m_per_s, earth);
  set_clock(e, anomaly, earth.mu_m3_per_s2, gps, state);
  return state;
}

}  // namespace inslab::satellites
