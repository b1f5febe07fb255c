#include "inslab/nav/standard_atmosphere.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::nav::standard_atmosphere {
namespace standard_atmosphere_test {

TEST(StandardAtmosphere, HasTheTablesOfIso2533) {
  // Geopotential height, temperature and pressure of ISO 2533:1975, table 5, as printed: six digits.
  struct Row {
    double height_m, temperature_k, pressure_pa;
  };
  for (const Row& row : {Row{-2000.0, 301.15, 127774.0}, Row{0.0, 288.15, 101325.0}, Row{1000.0, 281.65, 89874.6},
                         Row{2000.0, 275.15, 79495.2}, Row{3000.0, 268.65, 70108.5}, Row{5000.0, 255.65, 54019.9},
                         Row{10000.0, 223.15, 26436.2}, Row{11000.0, 216.65, 22632.0}, Row{20000.0, 216.65, 5474.88},
                         Row{32000.0, 228.65, 868.018}, Row{47000.0, 270.65, 110.906}, Row{51000.0, 270.65, 66.9388},
                         Row{71000.0, 214.65, 3.95641}}) {
    const Air air = air_at(row.height_m);
    EXPECT_NEAR(air.temperature_k, row.temperature_k, 1e-9) << row.height_m;
    EXPECT_NEAR(air.pressure_pa, row.pressure_pa, 5.1e-6 * row.pressure_pa) << row.height_m;
  }
  EXPECT_NEAR(air_at(0.0).density_kg_per_m3(), 1.225, 5e-7);
  EXPECT_NEAR(air_at(11000.0).density_kg_per_m3(), 0.363918, 5e-7);
}

TEST(StandardAtmosphere, GeopotentialHeightsAreThoseOfTheTables) {
  // ISO 2533, table 5: geometric 10 000 m are 9 984.3 m geopotential, 80 000 m are 79 005.7 m.
  EXPECT_NEAR(geopotential_height_m(10000.0), 9984.3, 0.05);
  EXPECT_NEAR(geopotential_height_m(80000.0), 79005.7, 0.06);
  EXPECT_NEAR(height_m(geopotential_height_m(30000.0)), 30000.0, 1e-8);
}

TEST(StandardAtmosphere, PressureAltitudeIsTheWayBack) {
  for (double height_m = -1500.0; height_m < 90000.0; height_m += 731.0) {
    EXPECT_NEAR(pressure_altitude_m(air_at(height_m).pressure_pa), height_m, 1e-8) << height_m;
  }
  EXPECT_TRUE(std::isnan(pressure_altitude_m(0.0)));
  EXPECT_TRUE(std::isnan(pressure_altitude_m(-5.0)));
}

TEST(StandardAtmosphere, OnAnyDayTheHydrostaticEquationHolds) {
  // A central difference of ln p over 1 m is off by dH^2/24 of its second derivative, 1e-9 of the slope at most.
  for (const double deviation_k : {-30.0, 0.0, 25.0}) {
    for (double height_m = -500.0; height_m < 85000.0; height_m += 1013.0) {
      const double lower = air_at(height_m - 0.5, 98000.0, deviation_k).pressure_pa;
      const double upper = air_at(height_m + 0.5, 98000.0, deviation_k).pressure_pa;
      const Air air = air_at(height_m, 98000.0, deviation_k);
      const double slope = -kGMPerS2 / (kGasConstantJPerKgK * air.temperature_k);
      EXPECT_NEAR(std::log(upper / lower), slope, 1e-8 * std::abs(slope)) << height_m << " " << deviation_k;
    }
  }
}

}  // namespace standard_atmosphere_test
}  // namespace inslab::nav::standard_atmosphere
