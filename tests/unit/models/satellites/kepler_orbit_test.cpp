#include "inslab/models/satellites/kepler_orbit.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/nominal_constellation.hpp"
#include "tests/unit/models/satellites/five_points.hpp"

namespace inslab::satellites {
namespace kepler_orbit_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// M = E - e sin E, solved backwards: E is given.
TEST(KeplersEquation, ItsSolutionIsWhatItWasMadeOf) {
  for (const double eccentricity : {0.0, 1e-4, 0.02, 0.3, 0.89}) {
    for (double e_rad = -3.1; e_rad < 3.1; e_rad += 0.05) {
      const double m_rad = e_rad - eccentricity * std::sin(e_rad);
      // The derivative of E by M is up to 1/(1-e): that much of M's rounding is E's.
      EXPECT_NEAR(eccentric_anomaly_rad(m_rad, eccentricity), e_rad, 2e-14 / (1.0 - eccentricity)) << e_rad;
    }
  }
}

/// A circle over the poles, without any correction.
KeplerianEphemeris polar_circle(GnssSystem system) {
  KeplerianEphemeris e;
  e.satellite = {system, 20};
  e.toe = e.toc = {2244, 100'000 * kSecond_ns};
  e.sqrt_a_sqrt_m = 5000.0;
  e.i0_rad = units::kPi / 2.0;
  return e;
}

// At its node, at longitude OMEGA0 less what the Earth turned since the week began; a quarter of a period later over
// the pole. Rates of the Earth and mu are those of the system's ICD.
TEST(KeplerOrbit, CircleOverThePoles) {
  struct Case {
    GnssSystem system;
    double mu, omega_e, behind_s;
  };
  for (const auto& [system, mu, omega_e, behind_s] : {Case{GnssSystem::Gps, 3.986005e14, 7.2921151467e-5, 0.0},
                                                      Case{GnssSystem::Qzss, 3.986005e14, 7.2921151467e-5, 0.0},
                                                      Case{GnssSystem::Galileo, 3.986004418e14, 7.2921151467e-5, 0.0},
                                                      Case{GnssSystem::BeiDou, 3.986004418e14, 7.292115e-5, 14.0}}) {
    const KeplerianEphemeris e = polar_circle(system);
    const double node_rad = -omega_e * (100'000.0 - behind_s);
    const SatelliteState at_node = kepler_state(e, e.toe);
    EXPECT_NEAR(at_node.r_e_m.x(), 25e6 * std::cos(node_rad), 1e-7);
    EXPECT_NEAR(at_node.r_e_m.y(), 25e6 * std::sin(node_rad), 1e-7);
    const double quarter_s = 0.5 * units::kPi / std::sqrt(mu / std::pow(25e6, 3));
    const SatelliteState over_pole = kepler_state(e, e.toe + time::from_seconds(quarter_s));
    EXPECT_NEAR(over_pole.r_e_m.z(), 25e6, 1e-6);
    EXPECT_NEAR(std::hypot(over_pole.r_e_m.x(), over_pole.r_e_m.y()), 0.0, 1e-5);  // 4 km/s by half a nanosecond
  }
}

// A quarter of a circle from the node in the plane of reference, which lies 5 deg askew: R_X(-5 deg) of
// BDS-SIS-ICD-B1I, section 5.2.4, takes (0, a, 0) to (0, a cos 5, a sin 5), and the Earth turns under it by R_Z.
TEST(KeplerOrbit, PlaneOfBeiDousGeostationarySatellitesIsAskew) {
  KeplerianEphemeris e = polar_circle(GnssSystem::BeiDou);
  e.satellite.number = 59;
  e.i0_rad = 0.0;
  e.m0_rad = units::kPi / 2.0;
  e.omega0_rad = 7.292115e-5 * (100'000.0 - 14.0);  // its node at the first axis
  const Vector3 askew(0.0, 25e6 * 0.99619469809174555, 25e6 * 0.087155742747658174);
  EXPECT_LT((kepler_state(e, e.toe).r_e_m - askew).norm(), 1e-7);
  // 100 s later: on its circle by n t, still in the plane askew, seen from an Earth turned by w t.
  const double on_rad = 100.0 * std::sqrt(3.986004418e14 / std::pow(25e6, 3)), turned_rad = 100.0 * 7.292115e-5;
  const double x_m = -25e6 * std::sin(on_rad), y_m = askew.y() * std::cos(on_rad);
  const Vector3 later(x_m * std::cos(turned_rad) + y_m * std::sin(turned_rad),
                      y_m * std::cos(turned_rad) - x_m * std::sin(turned_rad), askew.z() * std::cos(on_rad));
  EXPECT_LT((kepler_state(e, e.toe + std::chrono::seconds(100)).r_e_m - later).norm(), 1e-7);
}

// Harmonics are sines and cosines of twice the argument of latitude, here 30 deg: 1/2 and sqrt(3)/2.
TEST(KeplerOrbit, HarmonicsActOnRadiusLatitudeAndInclination) {
  KeplerianEphemeris e = polar_circle(GnssSystem::Gps);
  e.argument_of_perigee_rad = 15.0 * units::kDeg;
  e.crs_m = 200.0;
  e.crc_m = 100.0;
  const double radius_m = 25e6 + 100.0 + 50.0 * std::sqrt(3.0);
  EXPECT_NEAR(kepler_state(e, e.toe).r_e_m.norm(), radius_m, 1e-7);
  e.cus_rad = 4e-6;
  e.cuc_rad = 2e-6;
  const double u_rad = 15.0 * units::kDeg + 2e-6 + std::sqrt(3.0) * 1e-6;
  EXPECT_NEAR(kepler_state(e, e.toe).r_e_m.z(), radius_m * std::sin(u_rad), 1e-7);
  e.cis_rad = 6e-7;
  e.cic_rad = 8e-7;
  const double i_rad = units::kPi / 2.0 + 3e-7 + std::sqrt(3.0) * 4e-7;
  EXPECT_NEAR(kepler_state(e, e.toe).r_e_m.z(), radius_m * std::sin(u_rad) * std::sin(i_rad), 1e-7);
}

// Perigee and apogee, where sin E is 0 and the radius a (1 -+ e).
TEST(KeplerOrbit, EccentricOrbitHasPerigeeAndApogee) {
  KeplerianEphemeris e = polar_circle(GnssSystem::Gps);
  e.eccentricity = 0.01;
  EXPECT_NEAR(kepler_state(e, e.toe).r_e_m.norm(), 24.75e6, 1e-7);
  e.m0_rad = units::kPi;
  EXPECT_NEAR(kepler_state(e, e.toe).r_e_m.norm(), 25.25e6, 1e-7);
}

// -2 sqrt(mu)/c^2 e sqrtA sin E; at E = 90 deg M is 90 deg less e. F of GPS is -4.442807633e-10 (IS-GPS-200).
TEST(KeplerOrbit, ClockIsAPolynomialAndRelativity) {
  KeplerianEphemeris e = polar_circle(GnssSystem::Gps);
  e.eccentricity = 0.02;
  e.m0_rad = units::kPi / 2.0 - 0.02;
  e.af0_s = 1e-4;
  e.af1_s_per_s = 2e-11;
  e.af2_s_per_s2 = 1e-17;
  e.toc = e.toe + -std::chrono::seconds(1000);
  const SatelliteState state = kepler_state(e, e.toe);
  EXPECT_NEAR(state.clock_s, 1e-4 + 2e-8 + 1e-11 - 4.442807633e-10 * 0.02 * 5000.0, 1e-17);
  EXPECT_NEAR(state.drift_s_per_s, 2e-11 + 2e-14, 1e-18);  // cos E is 0
}

// Every satellite of the nominal constellation, with harmonics and all; the geostationary ones of BeiDou too. Rounding
// of positions of 4e7 m is 7e-9 m, of which five points a second apart make 1e-8 m/s.
TEST(KeplerOrbit, VelocityDriftAndAccelerationAreDerivatives) {
  const time::GpsTime start{2244, 36000 * kSecond_ns};
  for (const KeplerianEphemeris& e : nominal_constellation(7, start).keplerian) {
    for (const std::int64_t s : {-7000, 100, 5000}) {
      const auto state_at = [&](std::int64_t ns) {
        return kepler_state(e, e.toe + time::Nanoseconds(s * kSecond_ns + ns));
      };
      const SatelliteState state = state_at(0);
      const auto r_at = [&](std::int64_t ns) { return state_at(ns).r_e_m; };
      const auto v_at = [&](std::int64_t ns) { return state_at(ns).v_e_m_per_s; };
      const auto clock_at = [&](std::int64_t ns) { return state_at(ns).clock_s; };
      EXPECT_LT((test::five_point_derivative(r_at) - state.v_e_m_per_s).norm(), 1e-7) << name_of(e.satellite);
      EXPECT_NEAR(test::five_point_derivative(clock_at), state.drift_s_per_s, 1e-18) << name_of(e.satellite);
      // Gravity is not what the harmonics drawn at random make of the orbit: 300 m of radius at twice the rate.
      EXPECT_LT((test::five_point_derivative(v_at) - state.a_e_m_per_s2).norm(), 2e-4) << name_of(e.satellite);
    }
  }
}

}  // namespace kepler_orbit_test
}  // namespace inslab::satellites
