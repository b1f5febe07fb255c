#include "inslab/models/satellites/glonass_orbit.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/models/satellites/nominal_constellation.hpp"
#include "tests/unit/models/satellites/five_points.hpp"

namespace inslab::satellites {
namespace glonass_orbit_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
const time::GpsTime kStart{2244, 36000 * kSecond_ns};

GlonassEphemeris some_ephemeris() { return nominal_constellation(3, kStart).glonass[4]; }

/// What a free body keeps in axes that turn evenly (Jacobi): v^2/2 - w^2 (x^2 + y^2)/2 - U, with the ICD's constants.
double jacobi_m2_per_s2(const SatelliteState& state) {
  constexpr double kMu = 3.9860044e14, kRadius_m = 6378136.0, kJ2 = 1.0826257e-3, kW = 7.292115e-5;
  const Vector3& r = state.r_e_m;
  const double d = r.norm(), sine = r.z() / d, ratio = kRadius_m / d;
  const double potential = kMu / d * (1.0 - kJ2 * ratio * ratio * (1.5 * sine * sine - 0.5));
  return 0.5 * state.v_e_m_per_s.squaredNorm() - 0.5 * kW * kW * r.head<2>().squaredNorm() - potential;
}

// Of some 1.1e7 m^2/s^2: 1e-4 are 4e-8 m/s of a velocity of 3 km/s.
TEST(GlonassOrbit, KeepsJacobisIntegralForFiveDays) {
  GlonassOrbit orbit(some_ephemeris());
  const double at_first = jacobi_m2_per_s2(orbit.at(orbit.ephemeris().tb));
  for (int hours = -24; hours <= 120; hours += 6) {
    const SatelliteState state = orbit.at(orbit.ephemeris().tb + std::chrono::hours(hours));
    EXPECT_NEAR(jacobi_m2_per_s2(state), at_first, 1e-3) << hours;
  }
}

TEST(GlonassOrbit, VelocityAndAccelerationAreDerivatives) {
  GlonassOrbit orbit(some_ephemeris());
  // 7 s and 29 s beyond a node: the points lie on both sides of one. A step of 30 s errs by a micrometre, which grows
  // with the fifth power of its length: 2e-7 m/s at its end.
  for (const std::int64_t s : {-3607, 7, 929}) {
    const auto state_at = [&](std::int64_t ns) {
      return orbit.at(orbit.ephemeris().tb + time::Nanoseconds(s * kSecond_ns + ns));
    };
    const SatelliteState state = state_at(0);
    const auto r_at = [&](std::int64_t ns) { return state_at(ns).r_e_m; };
    const auto v_at = [&](std::int64_t ns) { return state_at(ns).v_e_m_per_s; };
    EXPECT_LT((test::five_point_derivative(r_at) - state.v_e_m_per_s).norm(), 4e-7) << s;
    EXPECT_LT((test::five_point_derivative(v_at) - state.a_e_m_per_s2).norm(), 1e-9) << s;
  }
}

TEST(GlonassOrbit, AnInstantsStateDoesNotDependOnWhatWasAskedBefore) {
  const time::GpsTime early = kStart + -std::chrono::hours(2), late = kStart + time::Nanoseconds(7'654'321'000'001);
  GlonassOrbit one(some_ephemeris()), other(some_ephemeris());
  const SatelliteState late_first = one.at(late), early_last = one.at(early);
  const SatelliteState early_first = other.at(early), late_last = other.at(late);
  EXPECT_EQ(late_first.r_e_m, late_last.r_e_m);
  EXPECT_EQ(early_first.r_e_m, early_last.r_e_m);
}

TEST(GlonassOrbit, MoonAndSunPullEvenly) {
  GlonassEphemeris pulled = some_ephemeris();
  pulled.lunisolar_e_m_per_s2 = {3e-6, -2e-6, 1e-6};
  GlonassOrbit orbit(some_ephemeris()), other(pulled);
  const time::GpsTime later = pulled.tb + std::chrono::minutes(10);
  const Vector3 moved_m = other.at(later).r_e_m - orbit.at(later).r_e_m;
  // a t^2 / 2; that the Earth turns by 2.5 deg and gravity changes along the way is some per cent of it.
  EXPECT_LT((moved_m - 0.5 * 600.0 * 600.0 * pulled.lunisolar_e_m_per_s2).norm(), 0.05 * moved_m.norm());
}

TEST(GlonassOrbit, ClockIsALine) {
  GlonassEphemeris e = some_ephemeris();
  e.tau_s = 2e-5;
  e.gamma = 3e-12;
  GlonassOrbit orbit(e);
  const SatelliteState state = orbit.at(e.tb + std::chrono::seconds(100));
  EXPECT_DOUBLE_EQ(state.clock_s, -2e-5 + 3e-10);
  EXPECT_EQ(state.drift_s_per_s, 3e-12);
}

}  // namespace glonass_orbit_test
}  // namespace inslab::satellites
