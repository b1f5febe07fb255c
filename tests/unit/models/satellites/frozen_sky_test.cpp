#include "inslab/models/satellites/frozen_sky.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/reference_time.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::satellites {
namespace frozen_sky_test {

const time::GpsTime kStart{2401, 300'000'000'000'000};

AntennaState beijing(const time::GpsTime& gps) {
  return {gps, 1e-10, nav::ecef_from_geodetic({39.9 * units::kDeg, 116.4 * units::kDeg, 50.0}), Vector3(3.0, 2.0, 1.0)};
}

TEST(FrozenSky, ShufflingSatellitesChangesNoBit) {
  BroadcastEphemerides records = nominal_constellation(1, kStart);
  FrozenSky one(records, kStart);
  std::reverse(records.keplerian.begin(), records.keplerian.end());
  std::rotate(records.keplerian.begin(), records.keplerian.begin() + 31, records.keplerian.end());
  std::reverse(records.glonass.begin(), records.glonass.end());
  FrozenSky other(records, kStart);
  other.seen_from(beijing(kStart + std::chrono::hours(3)), 0.0);  // and so do other questions before
  const auto gps = kStart + std::chrono::minutes(77);
  const auto seen = one.seen_from(beijing(gps), 0.1), same = other.seen_from(beijing(gps), 0.1);
  ASSERT_EQ(seen.size(), same.size());
  ASSERT_GT(seen.size(), 30u);  // five systems
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].satellite, same[i].satellite);
    EXPECT_EQ(seen[i].sight.light_time_s, same[i].sight.light_time_s);
    EXPECT_EQ(seen[i].sight.light_time_rate, same[i].sight.light_time_rate);
    EXPECT_EQ(seen[i].sight.clock_s, same[i].sight.clock_s);
    EXPECT_GE(seen[i].direction.elevation_rad, 0.1);
  }
}

// What a user computes from the messages is the truth to the bits: of Keplerian orbits 15 cm
// (nominal_constellation_test) and two hours of half of 2^-43 semicircles a second, 3 cm for each of three rates.
TEST(FrozenSky, MessagesAreTheOrbitsThroughoutTheRun) {
  FrozenSky sky(nominal_constellation(1, kStart), kStart);
  for (const int hours : {0, 1, 3, 60, 110}) {
    const time::GpsTime gps = kStart + std::chrono::hours(hours);
    const BroadcastEphemerides messages = sky.messages_at(gps);
    ASSERT_EQ(messages.keplerian.size(), sky.keplerian().size());
    for (std::size_t i = 0; i < messages.keplerian.size(); ++i) {
      const KeplerianEphemeris& e = messages.keplerian[i];
      EXPECT_EQ(e.toe, reference_time_at(e.satellite.system, gps));
      const SatelliteState told = kepler_state(e, gps), is = kepler_state(sky.keplerian()[i], gps);
      EXPECT_LT((told.r_e_m - is.r_e_m).norm(), 0.25) << name_of(e.satellite) << " " << hours;
      // Half of 2^-31 s, and two hours of half of 2^-43 s/s: 7 and 12 cm.
      EXPECT_NEAR(told.clock_s, is.clock_s, 0.2 / 299792458.0) << name_of(e.satellite) << " " << hours;
    }
    for (const GlonassEphemeris& e : messages.glonass) {
      EXPECT_EQ(e.tb, reference_time_at(GnssSystem::Glonass, gps));
      EXPECT_LE(std::chrono::abs(e.tb - gps), std::chrono::minutes(15));
    }
  }
}

TEST(FrozenSky, TakesTheHealthyRecordNearestToTheStart) {
  const KeplerianEphemeris first = nominal_constellation(1, kStart).keplerian[0];
  BroadcastEphemerides records;
  for (const int hours : {-4, -2, 0, 2})
    records.keplerian.push_back(re_referenced(first, first.toe + std::chrono::hours(hours)));
  const time::GpsTime start = first.toe + -std::chrono::minutes(10);
  EXPECT_EQ(FrozenSky(records, start).keplerian().at(0).toe, first.toe);
  records.keplerian[2].health = 1;
  EXPECT_EQ(FrozenSky(records, start).keplerian().at(0).toe, first.toe + -std::chrono::hours(2));
}

TEST(FrozenSky, GalileoIsINav) {
  BroadcastEphemerides records;
  records.keplerian = {nominal_constellation(1, kStart).keplerian[24]};
  records.keplerian.push_back(records.keplerian[0]);
  records.keplerian[0].message = KeplerianMessage::Fnav;
  records.keplerian[0].af0_s += 1e-9;
  const auto taken = FrozenSky(records, kStart).keplerian();
  ASSERT_EQ(taken.size(), 1u);
  EXPECT_EQ(taken[0].message, KeplerianMessage::Inav);
  EXPECT_EQ(taken[0].af0_s, records.keplerian[1].af0_s);
}

// Five years later every message still fits its bits, and every orbit is as high as it was.
TEST(FrozenSky, ServesAnOldFileAtAnotherDate) {
  FrozenSky sky(nominal_constellation(1, {2140, 0}), kStart);
  const BroadcastEphemerides messages = sky.messages_at(kStart);
  EXPECT_EQ(messages.keplerian.size(), 82u);
  ASSERT_EQ(messages.glonass.size(), 24u);
  for (const GlonassEphemeris& e : messages.glonass) EXPECT_NEAR(e.r_e_m.norm(), 25.508e6, 20e3);
  EXPECT_GT(sky.seen_from(beijing(kStart), 0.1).size(), 25u);
}

}  // namespace frozen_sky_test
}  // namespace inslab::satellites
