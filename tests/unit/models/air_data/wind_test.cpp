#include <gtest/gtest.h>

#include <cmath>

#include "inslab/models/air_data/mean_wind.hpp"
#include "inslab/models/air_data/turbulence_scales.hpp"

namespace inslab::air_data {
namespace wind_test {

constexpr double kFootM = 0.3048;

TEST(MeanWind, WithoutLevelsThereIsNone) { EXPECT_TRUE(mean_wind_ned_m_per_s({}, 100.0).isZero(0.0)); }

TEST(MeanWind, OfOneLevelGoesWithAPowerOfTheHeight) {
  WindField wind;
  wind.levels = {{10.0, {3.0, -4.0, 0.0}}};
  EXPECT_EQ(mean_wind_ned_m_per_s(wind, 0.0), Vector3(3.0, -4.0, 0.0));
  EXPECT_EQ(mean_wind_ned_m_per_s(wind, 900.0), Vector3(3.0, -4.0, 0.0));
  wind.power_law_exponent = 1.0 / 7.0;
  // (1280/10)^(1/7) = 2.
  EXPECT_NEAR((mean_wind_ned_m_per_s(wind, 1280.0) - Vector3(6.0, -8.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((mean_wind_ned_m_per_s(wind, 10.0 / 128.0) - Vector3(1.5, -2.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(mean_wind_ned_m_per_s(wind, -5.0).isZero(0.0)) << "a pit";
}

TEST(MeanWind, OfATableGoesInStraightLinesAndStaysAboveIt) {
  WindField wind;
  wind.levels = {{10.0, {4.0, 0.0, 0.0}}, {110.0, {8.0, 10.0, -1.0}}, {510.0, {0.0, 20.0, 0.0}}};
  wind.power_law_exponent = 0.5;
  EXPECT_NEAR((mean_wind_ned_m_per_s(wind, 2.5) - Vector3(2.0, 0.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((mean_wind_ned_m_per_s(wind, 10.0) - Vector3(4.0, 0.0, 0.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((mean_wind_ned_m_per_s(wind, 35.0) - Vector3(5.0, 2.5, -0.25)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((mean_wind_ned_m_per_s(wind, 310.0) - Vector3(4.0, 15.0, -0.5)).norm(), 0.0, 1e-14);
  EXPECT_EQ(mean_wind_ned_m_per_s(wind, 5000.0), Vector3(0.0, 20.0, 0.0));
}

void expect_scales(Turbulence turbulence, double height_ft, const Vector3& length_m, const Vector3& sigma_m_per_s) {
  const TurbulenceScales found = turbulence_scales(turbulence, height_ft * kFootM);
  EXPECT_NEAR((found.length_m - length_m).norm(), 0.0, 1e-3) << height_ft;
  EXPECT_NEAR((found.sigma_m_per_s - sigma_m_per_s).norm(), 0.0, 1e-5) << height_ft;
}

TEST(TurbulenceScales, NearTheGroundAreThoseOfLowAltitude) {
  // At 20 ft: 0.177 + 0.000823 h = 0.19346; light is a wind of 15 kt.
  expect_scales(Turbulence::Light, 20.0, {43.7659, 43.7659, 6.096}, {1.488652, 1.488652, 0.771667});
  // At 1000 ft all are alike: 1000 ft, and a tenth of the wind; severe is 45 kt.
  expect_scales(Turbulence::Severe, 1000.0, Vector3::Constant(304.8), Vector3::Constant(2.315));
  EXPECT_EQ(turbulence_scales(Turbulence::Moderate, 0.0).length_m,
            turbulence_scales(Turbulence::Moderate, 10.0 * kFootM).length_m);
  EXPECT_TRUE(turbulence_scales(Turbulence::None, 50.0).sigma_m_per_s.isZero(0.0));
}

TEST(TurbulenceScales, HighUpAreThoseOfFigure7) {
  const Vector3 length_m = Vector3::Constant(533.4);
  expect_scales(Turbulence::Moderate, 3750.0, length_m, Vector3::Constant(10.6 * kFootM));
  expect_scales(Turbulence::Severe, 7500.0, length_m, Vector3::Constant(23.6 * kFootM));
  expect_scales(Turbulence::Light, 30000.0, length_m, Vector3::Constant(1.55 * kFootM));
  expect_scales(Turbulence::Moderate, 90000.0, length_m, Vector3::Zero());
  expect_scales(Turbulence::Severe, 90000.0, length_m, Vector3::Constant(5.1 * kFootM));
}

TEST(TurbulenceScales, BetweenThemGoInStraightLines) {
  const double low_m_per_s = 0.1 * 15.0 * 1852.0 / 3600.0, high_m_per_s = (6.9 + 0.125 * 0.5) * kFootM;
  expect_scales(Turbulence::Light, 1500.0, Vector3::Constant(1375.0 * kFootM),
                Vector3::Constant(0.5 * (low_m_per_s + high_m_per_s)));
  for (const double height_ft : {1000.0, 2000.0}) {
    const TurbulenceScales below = turbulence_scales(Turbulence::Light, (height_ft - 1e-6) * kFootM);
    const TurbulenceScales above = turbulence_scales(Turbulence::Light, (height_ft + 1e-6) * kFootM);
    EXPECT_NEAR((below.length_m - above.length_m).norm(), 0.0, 1e-5) << height_ft;
    EXPECT_NEAR((below.sigma_m_per_s - above.sigma_m_per_s).norm(), 0.0, 1e-7) << height_ft;
  }
}

}  // namespace wind_test
}  // namespace inslab::air_data
