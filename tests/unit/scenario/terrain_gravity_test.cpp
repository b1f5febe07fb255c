#include "inslab/scenario/terrain_gravity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/gravity_grid.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::scenario {
namespace terrain_gravity_test {

constexpr double kArcsec_m_per_s2 = units::kG * units::kArcsec;

TEST(GravityAlongWay, IsNothingWhereGravityIsTheModels) { EXPECT_FALSE(gravity_along_way({}, nullptr).has_value()); }

// The mean square of a change over s = u D, of all three together: Jordan's correlations against the process's.
TEST(GravityAlongWay, ChangesOverShortWaysAsTheFieldDoes) {
  GravityOptions options;
  options.variation = GravityVariation{GravityTerrain::Mountains};
  const auto along_way = gravity_along_way(options, nullptr);
  ASSERT_TRUE(along_way.has_value());
  const double sigma = 15.0 * kArcsec_m_per_s2;
  EXPECT_NEAR(along_way->sigma_n.x(), sigma, 1e-15);
  EXPECT_NEAR(along_way->sigma_n.y(), sigma, 1e-15);
  EXPECT_NEAR(along_way->sigma_n.z(), std::sqrt(2.0) * sigma, 1e-15);
  for (const double u : {0.01, 0.1, 0.5}) {
    const double fall = std::exp(-u);
    const double field =
        (1.0 - (1.0 + u - u * u) * fall) + (1.0 - (1.0 + u) * fall) + 2.0 * (1.0 - (1.0 + u - 0.5 * u * u) * fall);
    const double v = u * options.variation->correlation_m / along_way->correlation_m;
    const double process = 4.0 * (1.0 - (1.0 + v) * std::exp(-v));
    // Of 4 u^2 the next terms are 10/3 u^3 and 8 sqrt(2)/3 u^3: 0.11 u apart.
    EXPECT_NEAR(process / field, 1.0, 0.15 * u) << u;
  }
}

// A constant adds to the sigma and has no slope: D grows with the root of the sum of the squares.
TEST(GravityAlongWay, AddsAConstantThatHasNoSlope) {
  GravityOptions options;
  options.deflection_north_arcsec = 8.0;
  options.disturbance_mgal = 30.0;
  const auto constant = gravity_along_way(options, nullptr);
  ASSERT_TRUE(constant.has_value());
  EXPECT_EQ(constant->correlation_m, 0.0);
  EXPECT_NEAR(constant->sigma_n.x(), 8.0 * kArcsec_m_per_s2, 1e-15);
  EXPECT_EQ(constant->sigma_n.y(), 0.0);
  EXPECT_NEAR(constant->sigma_n.z(), 3e-4, 1e-15);
  options.variation = GravityVariation{};
  const auto both = gravity_along_way(options, nullptr);
  EXPECT_NEAR(both->sigma_n.x(), 10.0 * kArcsec_m_per_s2, 1e-15);
  const double of_field = 4.0 * 36.0 * kArcsec_m_per_s2 * kArcsec_m_per_s2;
  EXPECT_NEAR(both->correlation_m, 20e3 / std::sqrt(2.0) * std::sqrt(both->sigma_n.squaredNorm() / of_field), 1e-6);
}

// Down A sin(k s) over the distance s to the north: A/sqrt(2), and a slope of A k/sqrt(2) to the north, none to the
// east, so half of its square both ways: D = sqrt(2)/k. Steps of 0.1/k show 4e-4 less of the slope.
TEST(GravityAlongWay, OfAGridIsThatOfItsKnots) {
  constexpr double kAmplitude = 2e-4, kStep = 0.1 * units::kPi / 3.0;
  constexpr std::size_t kRows = 241, kColumns = 3;  // four whole waves
  const double step_rad = 1e-4;
  std::vector<nav::Vector3> knots;
  for (std::size_t i = 0; i < kRows; ++i) {
    knots.insert(knots.end(), kColumns, {0.0, 0.0, kAmplitude * std::sin(kStep * static_cast<double>(i))});
  }
  const nav::GravityGrid grid({0.5, step_rad, kRows}, {2.0, step_rad, kColumns}, knots);
  const auto along_way = gravity_along_way({}, &grid);
  ASSERT_TRUE(along_way.has_value());
  EXPECT_NEAR(along_way->sigma_n.z(), kAmplitude / std::sqrt(2.0), 3e-3 * kAmplitude);
  const double step_m = step_rad * nav::wgs84::meridian_radius_from_sine_m(std::sin(0.5 + 120 * step_rad));
  EXPECT_NEAR(along_way->correlation_m, std::sqrt(2.0) * step_m / kStep, 5e-3 * step_m / kStep);
}

}  // namespace terrain_gravity_test
}  // namespace inslab::scenario
