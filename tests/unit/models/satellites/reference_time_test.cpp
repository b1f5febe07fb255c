#include "inslab/models/satellites/reference_time.hpp"

#include <gmock/gmock.h>

#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/nominal_constellation.hpp"

namespace inslab::satellites {
namespace reference_time_test {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
const time::GpsTime kFriday{2244, 5 * 86400 * kSecond_ns};

// From Friday to Wednesday, across the week's end. An angle of 46 rad after five days has the rounding of 7e-15 rad, at
// 4e7 m 3e-7 m; the argument of kepler_state() has it too.
TEST(ReReferenced, TheSameOrbitAndClockForFiveDaysAndAcrossTheWeek) {
  for (const KeplerianEphemeris& drawn : nominal_constellation(5, kFriday).keplerian) {
    const KeplerianEphemeris e = held_for_run(drawn);
    for (const int hours : {2, 50, 120}) {
      const time::GpsTime toe = e.toe + std::chrono::hours(hours);
      const KeplerianEphemeris moved = re_referenced(e, toe);
      EXPECT_EQ(moved.toe, toe);
      for (const int minutes : {-100, 0, 77}) {
        const time::GpsTime gps = toe + std::chrono::minutes(minutes);
        const SatelliteState was = kepler_state(e, gps), is = kepler_state(moved, gps);
        EXPECT_LT((was.r_e_m - is.r_e_m).norm(), 5e-7) << name_of(e.satellite) << " " << hours;
        EXPECT_LT((was.v_e_m_per_s - is.v_e_m_per_s).norm(), 1e-9) << name_of(e.satellite);
        EXPECT_NEAR(was.clock_s, is.clock_s, 1e-18) << name_of(e.satellite);
      }
    }
  }
}

TEST(ReReferenced, ClockWithAnAccelerationAndItsOwnReference) {
  KeplerianEphemeris e = nominal_constellation(5, kFriday).keplerian[0];
  e.toc = e.toe + -std::chrono::minutes(30);
  e.af2_s_per_s2 = 3e-17;
  const time::GpsTime toe = e.toe + std::chrono::hours(4), gps = toe + std::chrono::hours(1);
  EXPECT_NEAR(kepler_state(re_referenced(e, toe), gps).clock_s, kepler_state(e, gps).clock_s, 1e-18);
  EXPECT_NEAR(kepler_state(re_referenced(e, toe), gps).drift_s_per_s, kepler_state(e, gps).drift_s_per_s, 1e-20);
}

// A file of 2020 served in 2026: angles of some 1e5 turns.
TEST(ReReferenced, SixYearsOnTheOrbitIsOfTheSameShape) {
  const KeplerianEphemeris e = nominal_constellation(5, {2100, 0}).keplerian[3];
  const KeplerianEphemeris moved = re_referenced(e, e.toe + std::chrono::hours(24 * 365 * 6));
  const SatelliteState was = kepler_state(e, moved.toe), is = kepler_state(moved, moved.toe);
  // The argument of the first is 3e4 rad, rounded to 4e-12 rad.
  EXPECT_LT((was.r_e_m - is.r_e_m).norm(), 1e-3);
  EXPECT_LE(std::abs(moved.m0_rad), 3.15);
  EXPECT_LE(std::abs(moved.omega0_rad), 3.15);
}

TEST(ReReferenced, IssuesCountOn) {
  const auto all = nominal_constellation(5, kFriday).keplerian;
  KeplerianEphemeris gps = all[0], galileo = all[24];
  gps.issue_of_clock = gps.issue = 255;
  galileo.issue = 1022;
  const KeplerianEphemeris next = re_referenced(gps, gps.toe + std::chrono::hours(2));
  EXPECT_EQ(next.issue_of_clock, 256u);
  EXPECT_EQ(next.issue, 0u);  // the low octet
  EXPECT_EQ(re_referenced(galileo, galileo.toe + std::chrono::minutes(20)).issue, 0u);
  EXPECT_EQ(re_referenced(gps, gps.toe).issue, 255u);
}

TEST(ReReferenced, GlonassIsTheStateOfItsOrbit) {
  const GlonassEphemeris e = held_for_run(nominal_constellation(5, kFriday).glonass[0]);
  GlonassOrbit orbit(e);
  const time::GpsTime tb = e.tb + std::chrono::hours(7), gps = tb + std::chrono::minutes(12);
  GlonassOrbit moved(re_referenced(orbit, tb));
  // 7 h are whole steps of 30 s: both go on from the same node.
  EXPECT_LT((moved.at(gps).r_e_m - orbit.at(gps).r_e_m).norm(), 1e-7);
  EXPECT_NEAR(moved.at(gps).clock_s, orbit.at(gps).clock_s, 1e-18);
}

time::GpsTime at(int day, int hour, int minute, int second) {
  return {2244, (((day * 24LL + hour) * 60 + minute) * 60 + second) * kSecond_ns};
}

TEST(ReferenceTimes, LieOnTheGridsOfTheSystems) {
  const time::GpsTime gps = at(1, 10, 37, 5);
  EXPECT_EQ(reference_time_at(GnssSystem::Gps, gps), at(1, 12, 0, 0));
  EXPECT_EQ(reference_time_at(GnssSystem::Galileo, gps), at(1, 10, 30, 0));
  EXPECT_EQ(reference_time_at(GnssSystem::BeiDou, gps), at(1, 10, 0, 14));
  EXPECT_EQ(reference_time_at(GnssSystem::Glonass, gps), at(1, 10, 45, 18));  // 18 leap seconds
}

TEST(ReferenceTimes, BelongToTheIntervalThatBegins) {
  EXPECT_EQ(reference_time_at(GnssSystem::Gps, at(1, 10, 0, 0)), at(1, 12, 0, 0));
  EXPECT_EQ(reference_time_at(GnssSystem::Gps, {2244, at(1, 10, 0, 0).time_of_week_ns - 1}), at(1, 10, 0, 0));
  EXPECT_EQ(reference_time_at(GnssSystem::BeiDou, at(1, 10, 0, 13)), at(1, 9, 0, 14));
  EXPECT_EQ(reference_time_at(GnssSystem::Glonass, at(1, 10, 30, 17)), at(1, 10, 15, 18));
  EXPECT_EQ(reference_time_at(GnssSystem::Glonass, at(1, 10, 30, 18)), at(1, 10, 45, 18));
}

}  // namespace reference_time_test
}  // namespace inslab::satellites
