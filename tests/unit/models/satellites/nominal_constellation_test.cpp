#include "inslab/models/satellites/nominal_constellation.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>
#include <set>

#include "inslab/data/broadcast/message_field.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/gnss/constellation.hpp"
#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::satellites {
namespace nominal_constellation_test {

const time::GpsTime kStart{2401, 200'000'000'000'000};

TEST(NominalConstellation, HasEverySystem) {
  const BroadcastEphemerides all = nominal_constellation(1, kStart);
  std::map<GnssSystem, int> count;
  std::set<SatelliteId> names;
  for (const auto& e : all.keplerian) {
    ++count[e.satellite.system];
    names.insert(e.satellite);
  }
  EXPECT_EQ(count[GnssSystem::Gps], 24);
  EXPECT_EQ(count[GnssSystem::Galileo], 24);
  EXPECT_EQ(count[GnssSystem::BeiDou], 30);
  EXPECT_EQ(count[GnssSystem::Qzss], 4);
  EXPECT_EQ(names.size(), all.keplerian.size());
  EXPECT_EQ(all.glonass.size(), 24u);
}

// The slots on circles, as the receivers' geometry has them; on an ellipse a satellite is up to 2 e ahead or behind.
TEST(NominalConstellation, GpsAndGalileoAreInTheirSlots) {
  const auto slots = gnss::satellites_e_m(SatelliteModel::GpsGalileo, kStart);
  const auto all = nominal_constellation(1, kStart).keplerian;
  ASSERT_EQ(slots.size(), 48u);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const Vector3 found = kepler_state(all[i], kStart).r_e_m;
    const double off_rad = std::acos(found.normalized().dot(slots[i].normalized()));
    EXPECT_LT(off_rad, 2.0 * all[i].eccentricity + 1e-4) << name_of(all[i].satellite);
    EXPECT_NEAR(found.norm(), slots[i].norm(), slots[i].norm() * (all[i].eccentricity + 3e-4));
  }
}

TEST(NominalConstellation, SynchronousSatellitesStayOverTheirLongitudes) {
  const std::map<std::string, std::pair<double, double>> most{
      {"C38", {118.0, 17.0}}, {"C39", {118.0, 17.0}}, {"C40", {118.0, 17.0}}, {"C59", {140.0, 0.2}},
      {"C60", {80.0, 0.2}},   {"C61", {110.5, 0.2}},  {"J02", {135.0, 25.0}}, {"J03", {135.0, 25.0}},
      {"J04", {135.0, 25.0}}, {"J07", {127.0, 0.2}}};
  for (const auto& e : nominal_constellation(1, kStart).keplerian) {
    const auto found = most.find(name_of(e.satellite));
    if (found == most.end()) continue;
    const auto [longitude_deg, off_deg] = found->second;
    double sum_deg = 0.0;
    for (int hour = 0; hour < 24; ++hour) {
      const auto place = nav::geodetic_from_ecef(kepler_state(e, kStart + std::chrono::hours(hour)).r_e_m);
      const double deg = std::remainder(place.longitude_rad * units::kDegPerRad - longitude_deg, 360.0);
      EXPECT_LT(std::abs(deg), off_deg) << found->first << " " << hour;
      sum_deg += deg;
    }
    EXPECT_NEAR(sum_deg / 24.0, 0.0, 0.5) << found->first;
  }
}

// Three on one track over Japan: the time over the north is long, as the perigee lies in the south.
TEST(NominalConstellation, QzssIsHighOverTokyoAllDay) {
  const nav::Geodetic tokyo{35.7 * units::kDeg, 139.7 * units::kDeg, 50.0};
  const Vector3 r_e_m = nav::ecef_from_geodetic(tokyo);
  const Matrix3 C_ne = nav::C_en(tokyo.latitude_rad, tokyo.longitude_rad).transpose();
  for (int hour = 0; hour < 24; ++hour) {
    double highest_deg = 0.0;
    for (const auto& e : nominal_constellation(1, kStart).keplerian) {
      if (e.satellite.system != GnssSystem::Qzss || e.satellite.number == 7) continue;
      const Vector3 sight = C_ne * (kepler_state(e, kStart + std::chrono::hours(hour)).r_e_m - r_e_m).normalized();
      highest_deg = std::max(highest_deg, std::asin(-sight.z()) * units::kDegPerRad);
    }
    EXPECT_GT(highest_deg, 60.0) << hour;
  }
}

TEST(NominalConstellation, GlonassGoesRoundInItsPeriodOnCircles) {
  for (const auto& e : nominal_constellation(1, kStart).glonass) {
    GlonassOrbit orbit(e);
    for (int minutes = 0; minutes < 676; minutes += 60) {
      EXPECT_NEAR(orbit.at(e.tb + std::chrono::minutes(minutes)).r_e_m.norm(), 25.508e6, 10e3);
    }
    // 11 h 15 min 44 s later it has the same latitude again, but for the flattening's 1e-4 of the period, 5 s.
    EXPECT_NEAR(orbit.at(e.tb + std::chrono::seconds(40544)).r_e_m.z(), e.r_e_m.z(), 20e3) << name_of(e.satellite);
  }
}

TEST(NominalConstellation, OppositeSatellitesOfGlonassShareChannels) {
  const auto all = nominal_constellation(1, kStart).glonass;
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_TRUE(all[i].channel >= -7 && all[i].channel <= 6);
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (all[i].channel != all[j].channel) continue;
      EXPECT_LT(all[i].r_e_m.normalized().dot(all[j].r_e_m.normalized()), -0.99) << i + 1 << " " << j + 1;
    }
  }
}

// What is drawn fits the bits of the messages, and what they cut off is some centimetres of orbit and clock.
TEST(NominalConstellation, FitsTheBitsOfTheMessages) {
  double furthest_m = 0.0, furthest_clock_m = 0.0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const BroadcastEphemerides all = nominal_constellation(seed, kStart);
    for (const auto& e : all.keplerian) {
      const SatelliteState exact = kepler_state(e, e.toe), rounded = kepler_state(broadcast::as_broadcast(e), e.toe);
      furthest_m = std::max(furthest_m, (exact.r_e_m - rounded.r_e_m).norm());
      furthest_clock_m = std::max(furthest_clock_m, std::abs(exact.clock_s - rounded.clock_s) * 299792458.0);
    }
    for (const auto& e : all.glonass) EXPECT_NO_THROW(broadcast::as_broadcast(e));
  }
  // Half of 2^-31 semicircles of four angles at 4e7 m, 3 cm each, and 1 to 2 cm of each harmonic; half of 2^-31 s is
  // 7 cm.
  EXPECT_LT(furthest_m, 0.15);
  EXPECT_GT(furthest_m, 0.01);
  EXPECT_LT(furthest_clock_m, 0.071);
  EXPECT_GT(furthest_clock_m, 0.05);
}

TEST(NominalConstellation, NoTermIsZeroByAccidentAndSeedsDiffer) {
  const auto one = nominal_constellation(1, kStart).keplerian, other = nominal_constellation(2, kStart).keplerian;
  for (std::size_t i = 0; i < one.size(); ++i) {
    for (const auto& field : broadcast::keplerian_fields()) {
      // The nodes of the GPS standard's slots stand still, and its messages have one delay.
      const bool may_be_zero = field.name == "af2_s_per_s2" || is_beidou_geostationary(one[i].satellite) ||
                               (field.name == "omega_dot_rad_per_s" && one[i].satellite.system == GnssSystem::Gps) ||
                               (field.name == "second_delay_s" && one[i].message == KeplerianMessage::Lnav);
      if (may_be_zero) continue;
      EXPECT_NE(field.value(one[i]), 0.0) << name_of(one[i].satellite) << " " << field.name;
    }
    EXPECT_NE(one[i].af0_s, other[i].af0_s);
    EXPECT_NE(one[i].first_delay_s, one[(i + 1) % one.size()].first_delay_s);
  }
}

}  // namespace nominal_constellation_test
}  // namespace inslab::satellites
