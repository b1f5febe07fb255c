#include "inslab/nav/compressible_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::nav::compressible_flow {
namespace compressible_flow_test {

namespace atmosphere = standard_atmosphere;

TEST(CompressibleFlow, HasTheTablesOfNacaReport1135) {
  struct Row {
    double mach, static_over_total;
  };
  // Below the speed of sound table I, p/p_t; above it table II, p_1/p_t2: four digits, as printed.
  for (const Row& row : {Row{0.2, 0.9725}, Row{0.5, 0.8430}, Row{0.8, 0.6560}, Row{1.0, 0.5283}, Row{1.5, 0.2930},
                         Row{2.0, 0.1773}, Row{3.0, 0.08291}}) {
    EXPECT_NEAR(1.0 / (1.0 + impact_ratio(row.mach)), row.static_over_total, 5.1e-5) << row.mach;
  }
}

TEST(CompressibleFlow, IsOnePieceAtTheSpeedOfSound) {
  EXPECT_NEAR(impact_ratio(1.0), std::pow(1.2, 3.5) - 1.0, 1e-15);
  EXPECT_NEAR(impact_ratio(1.0 + 1e-9), impact_ratio(1.0), 1e-8);
  EXPECT_NEAR(mach_of(impact_ratio(1.0) * (1.0 + 1e-9)), 1.0, 1e-8);
}

TEST(CompressibleFlow, TheMachNumberIsTheWayBack) {
  for (double mach = 0.0; mach < 6.0; mach += 0.037) {
    EXPECT_NEAR(mach_of(impact_ratio(mach)), mach, 4e-15 * (1.0 + mach)) << mach;
  }
  // Slowly it is Bernoulli's: q_c/p = 0.7 M^2 (1 + M^2/4 + ...).
  EXPECT_NEAR(impact_ratio(1e-5), 0.7e-10, 1e-15 * 0.7e-5);
  EXPECT_NEAR(mach_of(0.7e-10), 1e-5, 1e-15);
}

TEST(CompressibleFlow, NoPressureIsNoSpeedAndNoNumberNone) {
  EXPECT_EQ(mach_of(0.0), 0.0);
  EXPECT_EQ(mach_of(-0.3), 0.0);
  EXPECT_TRUE(std::isnan(mach_of(std::nan(""))));
}

TEST(CompressibleFlow, TheSpeedOfSoundIsTheStandards) {
  // ISO 2533:1975, table 5, m/s.
  EXPECT_NEAR(speed_of_sound_m_per_s(288.15), 340.294, 5.1e-4);
  EXPECT_NEAR(speed_of_sound_m_per_s(216.65), 295.069, 5.1e-4);
}

TEST(CompressibleFlow, AtSeaLevelCalibratedAirspeedIsTrueAirspeed) {
  for (const double mach : {0.05, 0.5, 0.95, 1.7}) {
    const double true_m_per_s = true_airspeed_m_per_s(mach, 288.15 * (1.0 + 0.2 * mach * mach));
    EXPECT_NEAR(calibrated_airspeed_m_per_s(101325.0 * impact_ratio(mach)), true_m_per_s, 1e-11) << mach;
    EXPECT_NEAR(true_m_per_s, mach * 340.294, mach * 5.1e-4);
  }
}

TEST(CompressibleFlow, HighUpAnAirlinerShowsTheSpeedThatTheDefinitionGives) {
  // Flight level 370 is 11 277.6 m, 21 662.7 Pa; at Mach 0.84 the impact pressure is p ((1 + 0.2 M^2)^3.5 - 1), and the
  // calibrated airspeed is the one that has it in p_0 ((1 + 0.2 (v/a_0)^2)^3.5 - 1): 274 kt.
  const double pressure_pa = atmosphere::air_at(37000.0 * 0.3048).pressure_pa;
  const double impact_pa = pressure_pa * (std::pow(1.0 + 0.2 * 0.84 * 0.84, 3.5) - 1.0);
  const double shown_m_per_s = calibrated_airspeed_m_per_s(impact_pa);
  const double of_definition_pa = 101325.0 * (std::pow(1.0 + 0.2 * std::pow(shown_m_per_s / 340.294, 2.0), 3.5) - 1.0);
  EXPECT_NEAR(of_definition_pa, impact_pa, 1e-5 * impact_pa);
  EXPECT_NEAR(shown_m_per_s * 3600.0 / 1852.0, 274.2, 0.1);
  EXPECT_NEAR(true_airspeed_m_per_s(mach_of(impact_pa / pressure_pa), 216.65 * (1.0 + 0.2 * 0.84 * 0.84)),
              0.84 * 295.069, 5e-4);
}

}  // namespace compressible_flow_test
}  // namespace inslab::nav::compressible_flow
