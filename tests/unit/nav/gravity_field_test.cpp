#include "inslab/nav/gravity_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {
namespace gravity_field_test {

constexpr Geodetic kOrigin{45.0 * units::kDeg, 179.99 * units::kDeg, 300.0};
constexpr double kDeflection_rad = 6.0 * units::kArcsec;

double north_m_per_rad() { return wgs84::meridian_radius_from_sine_m(std::sin(kOrigin.latitude_rad)); }
double east_m_per_rad() {
  return wgs84::transverse_radius_from_sine_m(std::sin(kOrigin.latitude_rad)) * std::cos(kOrigin.latitude_rad);
}

/// Across the antimeridian, where that lies in the way.
Geodetic at(double north_m, double east_m, double height_m) {
  return {kOrigin.latitude_rad + north_m / north_m_per_rad(),
          wrapped_to_pi(kOrigin.longitude_rad + east_m / east_m_per_rad()), height_m};
}

GravityField field() {
  return GravityField(
      kOrigin, 50.0,
      {{2e-4, 1e-4, kDeflection_rad, 0.3}, {-6e-4, 1.2e-3, kDeflection_rad, 4.0}, {0.0, -5e-5, kDeflection_rad, 1.0}});
}

TEST(GravityField, OfOneWaveIsItsClosedForm) {
  const double k = 1e-4;
  const GravityField wave(kOrigin, 50.0, {{0.0, k, kDeflection_rad, 0.0}});
  // T = g0 a cos(k y) exp(-k z): a quarter of a wave to the east all of it is level, at the crest all of it is upright.
  const Vector3 quarter = wave.exact_n(at(1000.0, 0.5 * units::kPi / k, 0.0));
  EXPECT_NEAR(quarter.y(), -units::kG * kDeflection_rad, 1e-12);
  EXPECT_NEAR(quarter.z(), 0.0, 1e-12);
  const Vector3 crest = wave.exact_n(at(-2000.0, 0.0, 5000.0));
  EXPECT_NEAR(crest.z(), units::kG * kDeflection_rad * std::exp(-0.5), 1e-15) << "down: attraction by the mass below";
  EXPECT_NEAR(crest.head<2>().norm(), 0.0, 1e-15);
}

TEST(GravityField, HasNoCurlAndNoDivergence) {
  const GravityField gravity = field();
  const double step_m = 10.0;
  for (const double height_m : {500.0, 8000.0}) {
    Matrix3 by_place;  // columns: north, east, down
    for (int axis = 0; axis < 3; ++axis) {
      Vector3 step = Vector3::Zero();
      step[axis] = step_m;
      const auto there = [&](double sign) {
        return gravity.exact_n(at(1234.0 + sign * step.x(), -987.0 + sign * step.y(), height_m - sign * step.z()));
      };
      by_place.col(axis) = (there(1.0) - there(-1.0)) / (2.0 * step_m);
    }
    const double size = by_place.norm();
    EXPECT_LT((by_place - by_place.transpose()).norm(), 1e-4 * size);
    EXPECT_LT(std::abs(by_place.trace()), 1e-4 * size);
  }
}

TEST(GravityField, ByPowersIsTheExactOneWhateverTheWayThere) {
  const GravityField gravity = field();
  GravityField::Cell walked;
  double largest = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Geodetic place = at(-3000.0 + 1.7 * i, 4000.0 - 2.3 * i, 0.4 * i - 50.0);
    GravityField::Cell fresh;
    const Vector3 by_powers = gravity.disturbance_n(place, walked);
    EXPECT_EQ(by_powers, gravity.disturbance_n(place, fresh));
    largest = std::max(largest, (by_powers - gravity.exact_n(place)).norm());
  }
  // The shortest wave has |k| cell = 0.067, and its powers end before the fourth.
  EXPECT_LT(largest, std::pow(0.067, 4) / 42.0 * units::kG * kDeflection_rad);
  EXPECT_GT(largest, 0.0);
}

TEST(GravityField, BelowTheEllipsoidIsThatOnIt) {
  EXPECT_EQ(field().exact_n(at(100.0, 100.0, -300.0)), field().exact_n(at(100.0, 100.0, 0.0)));
}

TEST(GravityField, RefusesWavesWithoutLength) {
  EXPECT_THROW(GravityField(kOrigin, 50.0, {{0.0, 0.0, 1e-5, 0.0}}), std::invalid_argument);
  EXPECT_THROW(GravityField(kOrigin, 0.0, {{1e-4, 0.0, 1e-5, 0.0}}), std::invalid_argument);
}

TEST(Gravity, WithAFieldIsTheUniformOneAndTheField) {
  const auto waves = std::make_shared<GravityField>(field());
  const Gravity::Disturbance constant{20.0, 5.0, -3.0};
  const Gravity with(GravityModel::Normal, constant, waves), without(GravityModel::Normal, constant);
  const Geodetic place = at(700.0, 1500.0, 900.0);
  GravityField::Cell cell;
  EXPECT_EQ(with.g_n(place), Vector3(without.g_n(place) + waves->disturbance_n(place, cell)));
  EXPECT_LT((with.gravitation_e(place) - without.gravitation_e(place) -
             C_en(place.latitude_rad, place.longitude_rad) * waves->disturbance_n(place, cell))
                .norm(),
            1e-14);
  EXPECT_TRUE(with.is_disturbed());
  EXPECT_TRUE(without.is_disturbed());
  EXPECT_FALSE(Gravity(GravityModel::Normal).is_disturbed());
}

}  // namespace gravity_field_test
}  // namespace inslab::nav
