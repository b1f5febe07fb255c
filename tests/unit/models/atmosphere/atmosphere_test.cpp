#include <gmock/gmock.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/atmosphere/klobuchar.hpp"
#include "inslab/models/atmosphere/niell.hpp"
#include "inslab/models/atmosphere/saastamoinen.hpp"

namespace inslab::atmosphere {
namespace atmosphere_test {

constexpr double kLight_m_per_s = 299792458.0;
const nav::Geodetic kPlace{40.0 * units::kDeg, -100.0 * units::kDeg, 170.0};

BroadcastIonosphere example() {
  return {GnssSystem::Gps, {0.3820e-7, 0.1490e-7, -0.1790e-6, 0.0}, {0.1430e6, 0.0, -0.3280e6, 0.1130e6}};
}

double example_delay_m(double azimuth_deg, double elevation_deg, double seconds) {
  return kLight_m_per_s * klobuchar_delay_s(example(), kPlace, azimuth_deg * units::kDeg, elevation_deg * units::kDeg,
                                            {1042, time::from_seconds(seconds).count()});
}

// The worked example of A. Farah's and J. Klobuchar's algorithm (40 N, 100 W, azimuth 210 deg, elevation 20 deg, 593100
// s of the week): 23.784 m.
TEST(Klobuchar, WorkedExample) { EXPECT_NEAR(example_delay_m(210.0, 20.0, 593100.0), 23.784, 1e-3); }

// At night 5 ns times the obliquity factor, which is 1 + 16 (0.53 - 0.5)^3 at the zenith.
TEST(Klobuchar, FiveNanosecondsAtNight) {
  const double midnight_s = 5.0 * 86400.0 + 100.0 / 360.0 * 86400.0;  // at 100 W
  EXPECT_NEAR(example_delay_m(0.0, 90.0, midnight_s), 5e-9 * (1.0 + 16.0 * 0.03 * 0.03 * 0.03) * kLight_m_per_s, 1e-9);
}

TEST(Klobuchar, IsLargestAtTwoInTheAfternoonAndAlikeEveryDay) {
  const double two_s = (14.0 + 100.0 / 15.0) * 3600.0;
  EXPECT_GT(example_delay_m(0.0, 90.0, two_s), example_delay_m(0.0, 90.0, two_s + 3600.0));
  EXPECT_GT(example_delay_m(0.0, 90.0, two_s), example_delay_m(0.0, 90.0, two_s - 3600.0));
  EXPECT_NEAR(example_delay_m(0.0, 90.0, two_s), example_delay_m(0.0, 90.0, two_s + 86400.0), 1e-9);
}

// 1013.25 hPa at the sea and 898.74 hPa at 1000 m (U.S. Standard Atmosphere 1976); at 45 deg the term of latitude is 0.
TEST(Saastamoinen, DryDelayIsThePressures) {
  const nav::Geodetic sea{45.0 * units::kDeg, 0.0, 0.0}, hill{45.0 * units::kDeg, 0.0, 1000.0};
  EXPECT_NEAR(saastamoinen_zenith(sea).dry_m, 0.0022768 * 1013.25, 1e-9);
  EXPECT_NEAR(saastamoinen_zenith(hill).dry_m, 0.0022768 * 898.74 / (1.0 - 0.00028), 2e-4);
}

// Saturated vapour at 15 C has 17.04 hPa (Goff-Gratch): 0.002277 (1255/288.15 + 0.05) 0.7 17.04 hPa = 0.1196 m.
TEST(Saastamoinen, WetDelayIsTheVapours) {
  const nav::Geodetic sea{45.0 * units::kDeg, 0.0, 0.0};
  EXPECT_NEAR(saastamoinen_zenith(sea).wet_m, 0.1196, 1e-3);
  EXPECT_EQ(saastamoinen_zenith(sea, 0.0).wet_m, 0.0);
}

TEST(Saastamoinen, BelowTheSeaAsAtIt) {
  const nav::Geodetic sea{0.5, 0.0, 0.0}, below{0.5, 0.0, -50.0}, mine{0.5, 0.0, -101.0}, space{0.5, 0.0, 10001.0};
  EXPECT_EQ(saastamoinen_zenith(below).dry_m, saastamoinen_zenith(sea).dry_m);
  EXPECT_EQ(saastamoinen_zenith(mine).dry_m, 0.0);
  EXPECT_EQ(saastamoinen_zenith(space).wet_m, 0.0);
}

TEST(Saastamoinen, CosecantOfTheElevation) {
  const ZenithDelay zenith = saastamoinen_zenith(kPlace);
  EXPECT_NEAR(saastamoinen_cosecant_m(kPlace, units::kPi / 6.0), 2.0 * (zenith.dry_m + zenith.wet_m), 1e-12);
  EXPECT_EQ(saastamoinen_cosecant_m(kPlace, 0.0), 0.0);
}

TEST(Niell, IsOneAtTheZenith) {
  for (const double height_m : {0.0, 2000.0}) {
    const Mapping mapping = niell_mapping({0.6, 0.0, height_m}, units::kPi / 2.0, 180.0);
    EXPECT_NEAR(mapping.dry, 1.0, 1e-12);
    EXPECT_NEAR(mapping.wet, 1.0, 1e-12);
  }
}

// Chao's mapping functions (1974) are of other data: within 1 % of the dry gases and 4 % of water at 5 deg, where the
// cosecant is 13 % off.
TEST(Niell, BendsLessThanTheCosecantNearTheHorizon) {
  const double e = 5.0 * units::kDeg;
  const Mapping mapping = niell_mapping({45.0 * units::kDeg, 0.0, 0.0}, e, 28.0 + 365.25 / 4.0);
  const double chao_dry = 1.0 / (std::sin(e) + 0.00143 / (std::tan(e) + 0.0445));
  const double chao_wet = 1.0 / (std::sin(e) + 0.00035 / (std::tan(e) + 0.017));
  EXPECT_NEAR(mapping.dry, chao_dry, 0.01 * chao_dry);
  EXPECT_NEAR(mapping.wet, chao_wet, 0.04 * chao_wet);
}

// 1/sin E less the fraction of Niell's coefficients of height, worked out apart: 0.02197 per km at 5 deg.
TEST(Niell, DryGasesHaveATermOfHeight) {
  const double e = 5.0 * units::kDeg;
  const Mapping low = niell_mapping({0.7, 0.0, 0.0}, e, 100.0), high = niell_mapping({0.7, 0.0, 1000.0}, e, 100.0);
  EXPECT_NEAR(high.dry - low.dry, 0.02197, 1e-5);
  EXPECT_EQ(high.wet, low.wet);
}

TEST(Niell, SouthHasItsWinterHalfAYearLater) {
  const nav::Geodetic north{50.0 * units::kDeg, 0.0, 100.0}, south{-50.0 * units::kDeg, 0.0, 100.0};
  EXPECT_NEAR(niell_mapping(north, 0.2, 28.0).dry, niell_mapping(south, 0.2, 28.0 + 365.25 / 2.0).dry, 1e-12);
  EXPECT_GT(niell_mapping(north, 0.2, 28.0).dry, niell_mapping(north, 0.2, 28.0 + 365.25 / 2.0).dry + 1e-4);
}

}  // namespace atmosphere_test
}  // namespace inslab::atmosphere
