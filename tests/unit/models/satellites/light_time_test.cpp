#include "inslab/models/satellites/light_time.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "inslab/data/broadcast/message_field.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/group_delay.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/nominal_constellation.hpp"
#include "inslab/nav/geodesy.hpp"
#include "tests/unit/models/satellites/five_points.hpp"

namespace inslab::satellites {
namespace light_time_test {

constexpr double kC = 299792458.0;
const time::GpsTime kNow{2401, 123'456'000'000'000};
const Vector3 kAntenna_e_m = nav::ecef_from_geodetic({0.6, 1.9, 200.0});

AntennaState antenna_at(const time::GpsTime& gps) { return {gps, 0.0, kAntenna_e_m, Vector3(30.0, -100.0, 50.0)}; }

Sight seen(const KeplerianEphemeris& e, const AntennaState& antenna, time::Nanoseconds before) {
  return sight({kepler_state(e, antenna.gps + -before), before}, antenna);
}

/// Satellites without drawn harmonics, of which gravity knows nothing.
std::vector<KeplerianEphemeris> plain_satellites() {
  std::vector<KeplerianEphemeris> all = nominal_constellation(1, kNow).keplerian;
  for (KeplerianEphemeris& e : all) e.cuc_rad = e.cus_rad = e.crc_m = e.crs_m = e.cic_rad = e.cis_rad = 0.0;
  return all;
}

// What is left of the equation, with the Earth's turn written as a rotation by Eigen.
TEST(LightTime, SolvesItsEquation) {
  for (const KeplerianEphemeris& e : plain_satellites()) {
    const Sight found = seen(e, antenna_at(kNow), usual_light_time(e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m));
    // The instant of transmission as whole nanoseconds and a rest, by which the satellite moves at its velocity.
    const auto whole = time::Nanoseconds(std::llround(found.light_time_s * 1e9));
    const SatelliteState state = kepler_state(e, kNow + -whole);
    const double rest_s = time::to_seconds(whole) - found.light_time_s;
    const Vector3 r_e_m = state.r_e_m + rest_s * state.v_e_m_per_s;
    const Vector3 q_e_m =
        Eigen::AngleAxisd(-7.2921151467e-5 * found.light_time_s, Vector3::UnitZ()).toRotationMatrix() * r_e_m;
    EXPECT_NEAR(kC * found.light_time_s, (q_e_m - kAntenna_e_m).norm(), 5e-8) << name_of(e.satellite);
    EXPECT_LT((found.line_e - (q_e_m - kAntenna_e_m).normalized()).norm(), 1e-13);
    EXPECT_NEAR(found.clock_s, state.clock_s + rest_s * state.drift_s_per_s, 1e-18);
  }
}

// The departure is only where the course is known: 20 ms earlier or later it is the same light time, but for what the
// acceleration lacks: 5e-5 m/s^2 of the flattening, which these ellipses do not follow, and as much of their drawn
// mean motion. Over the time between departure and transmission that is half of it times the square.
TEST(LightTime, DoesNotDependOnTheDeparture) {
  for (const KeplerianEphemeris& e : plain_satellites()) {
    const auto before = usual_light_time(e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m);
    const double tau_s = seen(e, antenna_at(kNow), before).light_time_s;
    for (const int ms : {-20, 20}) {
      const Sight other = seen(e, antenna_at(kNow), before + std::chrono::milliseconds(ms));
      const double between_s = std::abs(time::to_seconds(before) - tau_s) + 0.02;
      constexpr double kLacks_m_per_s2 = 1e-4, kRounding_m = 1.5e-8;
      EXPECT_NEAR(kC * other.light_time_s, kC * tau_s, 0.5 * kLacks_m_per_s2 * between_s * between_s + kRounding_m)
          << name_of(e.satellite);
    }
  }
}

TEST(LightTime, RestOfANanosecondCounts) {
  const KeplerianEphemeris e = plain_satellites()[30];
  AntennaState antenna = antenna_at(kNow);
  const Sight at_once = seen(e, antenna, usual_light_time(25e6));
  antenna.rest_s = 4e-7;
  const Sight later = seen(e, antenna, usual_light_time(25e6));
  // The antenna stands where it stood: the range changes by the satellite's part alone.
  const Vector3 none = Vector3::Zero();
  AntennaState still = antenna_at(kNow);
  still.v_e_m_per_s = none;
  const double rate = seen(e, still, usual_light_time(25e6)).light_time_rate;
  EXPECT_NEAR(kC * (later.light_time_s - at_once.light_time_s), kC * rate * 4e-7, 2e-8);
}

// Five points a second apart; light times of 0.13 s are rounded to 3e-17 s, 8e-9 m.
TEST(LightTime, RateIsTheDerivative) {
  double most_m_per_s = 0.0;
  for (const KeplerianEphemeris& e : nominal_constellation(1, kNow).keplerian) {
    const auto before = usual_light_time(e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m);
    const Vector3 v(200.0, -150.0, 50.0);
    const auto antenna_after = [&](std::int64_t ns) {
      return AntennaState{kNow + time::Nanoseconds(ns), 0.0, kAntenna_e_m + time::to_seconds(ns) * v, v};
    };
    const auto tau_at = [&](std::int64_t ns) { return seen(e, antenna_after(ns), before).light_time_s; };
    const double rate = seen(e, antenna_after(0), before).light_time_rate;
    most_m_per_s = std::max(most_m_per_s, kC * std::abs(test::five_point_derivative(tau_at) - rate));
  }
  // The drawn harmonics pull by 1e-4 m/s^2 what gravity does not know, over 50 ms.
  EXPECT_LT(most_m_per_s, 5e-6);
}

TEST(Direction, AzimuthFromNorthOverEast) {
  const nav::Geodetic place{0.7, -1.2, 0.0};
  const Matrix3 C_en = nav::C_en(place.latitude_rad, place.longitude_rad);
  const double a = 2.0, e = 0.4;
  const Vector3 line_n(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), -std::sin(e));
  const AzimuthElevation found = direction_of(C_en * line_n, C_en);
  EXPECT_NEAR(found.azimuth_rad, a, 1e-14);
  EXPECT_NEAR(found.elevation_rad, e, 1e-14);
}

// BGD(E1,E5a) 7 ns, BGD(E1,E5b) 5 ns: the F/NAV clock is 2 ns ahead, and its E1 7 ns late beside it.
TEST(GroupDelay, FnavIsTheClockOfTheOtherPair) {
  KeplerianEphemeris inav;
  inav.satellite = {GnssSystem::Galileo, 1};
  inav.message = KeplerianMessage::Inav;
  inav.first_delay_s = 7e-9;
  inav.second_delay_s = 5e-9;
  const KeplerianEphemeris fnav = fnav_of(inav);
  EXPECT_NEAR(fnav.af0_s, 2e-9, 1e-20);
  EXPECT_NEAR(group_delay_s(broadcast::gnss_signal(GnssSystem::Galileo, "1C"), fnav), 7e-9, 1e-20);
  for (const char* rinex : {"1C", "7Q", "5Q"}) {
    const auto& signal = broadcast::gnss_signal(GnssSystem::Galileo, rinex);
    EXPECT_NEAR(group_delay_s(signal, inav) - inav.af0_s, group_delay_s(signal, fnav) - fnav.af0_s, 1e-20) << rinex;
  }
  EXPECT_EQ(fnav_of(inav).message, KeplerianMessage::Fnav);
}

TEST(GroupDelay, OfGlonassIsThatOfG2) {
  GlonassEphemeris e;
  e.delta_tau_s = 3e-9;
  EXPECT_EQ(group_delay_s(broadcast::gnss_signal(GnssSystem::Glonass, "1C"), e), 0.0);
  EXPECT_EQ(group_delay_s(broadcast::gnss_signal(GnssSystem::Glonass, "2C"), e), 3e-9);
}

}  // namespace light_time_test
}  // namespace inslab::satellites
