#include "inslab/nav/gravity_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::nav {
namespace gravity_grid_test {

constexpr std::size_t kRows = 7, kColumns = 9;
constexpr GravityGrid::Axis kLatitude{45.0 * units::kDeg, 0.02 * units::kDeg, kRows};
/// Across the antimeridian.
constexpr GravityGrid::Axis kLongitude{179.9 * units::kDeg, 0.03 * units::kDeg, kColumns};

/// A place by its distance from the first knot in steps; the longitude within half a turn of 0.
Geodetic at(double row, double column, double height_m = 0.0) {
  return {kLatitude.first_rad + row * kLatitude.step_rad,
          wrapped_to_pi(kLongitude.first_rad + column * kLongitude.step_rad), height_m};
}

template <class Function>
GravityGrid grid_of(const Function& function) {
  std::vector<Vector3> values;
  for (std::size_t i = 0; i < kRows; ++i) {
    for (std::size_t j = 0; j < kColumns; ++j) values.push_back(function(double(i), double(j)));
  }
  return GravityGrid(kLatitude, kLongitude, values);
}

/// A polynomial of the second degree along both, another one for each component.
Vector3 parabolas(double row, double column) {
  return 1e-5 * Vector3(1.0 + 2.0 * row - 0.3 * row * row + column * column,
                        3.0 - row * column + 0.2 * row * row * column * column, 0.5 * column - row);
}

Vector3 waves(double row, double column) {
  return 1e-5 * Vector3(std::sin(0.9 * row + 0.4 * column), std::cos(0.7 * column), std::sin(0.8 * row));
}

TEST(GravityGrid, GoesThroughItsKnots) {
  const GravityGrid grid = grid_of(waves);
  for (std::size_t i = 0; i < kRows; ++i) {
    for (std::size_t j = 0; j < kColumns; ++j) {
      EXPECT_LT((grid.disturbance_n(at(double(i), double(j))) - waves(double(i), double(j))).norm(), 1e-15);
    }
  }
}

TEST(GravityGrid, IsExactForParabolasUpToItsBorder) {
  const GravityGrid grid = grid_of(parabolas);
  for (double row = 0.0; row <= kRows - 1; row += 0.23) {
    for (double column = 0.0; column <= kColumns - 1; column += 0.31) {
      EXPECT_LT((grid.disturbance_n(at(row, column, 5000.0)) - parabolas(row, column)).norm(), 1e-14)
          << row << " " << column;
    }
  }
}

TEST(GravityGrid, HasAContinuousSlopeAtItsKnots) {
  const GravityGrid grid = grid_of(waves);
  constexpr double h = 1e-5;
  for (std::size_t knot = 1; knot + 1 < kRows; ++knot) {
    const double row = double(knot), column = 3.4;
    const Vector3 here = grid.disturbance_n(at(row, column));
    const Vector3 before = (here - grid.disturbance_n(at(row - h, column))) / h;
    const Vector3 after = (grid.disturbance_n(at(row + h, column)) - here) / h;
    EXPECT_LT((after - before).norm(), 1e-9);
    EXPECT_GT(before.norm(), 1e-6);
  }
}

TEST(GravityGrid, BeyondItsBorderIsThatOfTheBorder) {
  const GravityGrid grid = grid_of(waves);
  const auto differ = [&grid](const Geodetic& a, const Geodetic& b) {
    return (grid.disturbance_n(a) - grid.disturbance_n(b)).norm();
  };
  EXPECT_LT(differ(at(-3.0, 2.3), at(0.0, 2.3)), 1e-15);
  EXPECT_LT(differ(at(4.2, kColumns + 5.0), at(4.2, kColumns - 1.0)), 1e-15);
  EXPECT_TRUE(grid.contains(at(0.0, 0.0)));
  EXPECT_TRUE(grid.contains(at(kRows - 1.0, kColumns - 1.0)));
  EXPECT_FALSE(grid.contains(at(-0.01, 2.0)));
  EXPECT_FALSE(grid.contains(at(2.0, kColumns - 0.99)));
}

TEST(GravityGrid, IsAddedToTheModel) {
  const auto grid = std::make_shared<const GravityGrid>(grid_of(waves));
  const Gravity model(GravityModel::Normal), varying(GravityModel::Normal, {}, nullptr, grid);
  const Geodetic place = at(2.6, 5.1, 120.0);
  EXPECT_LT((varying.g_n(place) - model.g_n(place) - grid->disturbance_n(place)).norm(), 1e-14);
  EXPECT_TRUE(varying.is_disturbed());
  EXPECT_FALSE(model.is_disturbed());
}

TEST(GravityGrid, RefusesWhatIsNoGrid) {
  EXPECT_THROW(GravityGrid(kLatitude, kLongitude, std::vector<Vector3>(kRows * kColumns - 1)), std::invalid_argument);
  const GravityGrid::Axis two_knots{0.0, 1e-3, 2}, no_step{0.0, 0.0, 3};
  EXPECT_THROW(GravityGrid(two_knots, kLongitude, std::vector<Vector3>(2 * kColumns)), std::invalid_argument);
  EXPECT_THROW(GravityGrid(no_step, kLongitude, std::vector<Vector3>(3 * kColumns)), std::invalid_argument);
}

}  // namespace gravity_grid_test
}  // namespace inslab::nav
