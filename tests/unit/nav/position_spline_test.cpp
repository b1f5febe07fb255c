#include "inslab/nav/position_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {
namespace position_spline_test {

// Half a unit in the last place of a longitude of 3 rad, in metres on the equator.
constexpr double kPlace_m = 2.9e-9;

Geodetic degrees(double latitude, double longitude, double height_m) {
  return {latitude * units::kDeg, longitude * units::kDeg, height_m};
}

Matrix3 C_en_at(const Geodetic& place) { return C_en(place.latitude_rad, place.longitude_rad); }

/// A bent track with uneven intervals over the antimeridian, in the south.
struct Track {
  std::vector<Geodetic> points;
  std::vector<double> intervals;
};
Track track() {
  Track t;
  for (int k = 0; k < 12; ++k) {
    t.points.push_back(degrees(-41.0 + 0.02 * k + 0.005 * (k % 3), 179.9 + 0.03 * k, 100.0 + 40.0 * (k % 4)));
    t.points.back().longitude_rad = wrapped_to_pi(t.points.back().longitude_rad);
    if (k > 0) t.intervals.push_back(1.0 + 0.7 * (k % 5));
  }
  return t;
}

struct CurveInE {
  Vector3 first;
  Vector3 second;
};
CurveInE at(const PositionPiece& piece, double u) {
  const Matrix3 C_ek = C_en_at(piece.origin);
  return {C_ek * piece.first_k(u), C_ek * piece.second_k(u)};
}

TEST(PositionSpline, PassesThroughItsPoints) {
  const Track t = track();
  const PositionSpline spline(t.points, t.intervals, {});
  ASSERT_EQ(spline.pieces(), 11u);
  for (std::size_t k = 0; k < spline.pieces(); ++k) {
    const PositionPiece piece = spline.piece(k);
    EXPECT_EQ(piece.origin.latitude_rad, t.points[k].latitude_rad);
    EXPECT_EQ(piece.origin.longitude_rad, t.points[k].longitude_rad);
    const Geodetic end = displaced(piece.origin, piece.displacement_k(t.intervals[k]));
    EXPECT_LT(ned_from(t.points[k + 1], end).norm(), kPlace_m) << k;
  }
}

TEST(PositionSpline, HasContinuousFirstAndSecondDerivatives) {
  // Second derivatives of some 1e3 m over a few s^2, from chords of 4 km that are good to 1e-9 m.
  const Track t = track();
  const PositionSpline spline(t.points, t.intervals, {});
  for (std::size_t k = 1; k < spline.pieces(); ++k) {
    const CurveInE before = at(spline.piece(k - 1), t.intervals[k - 1]), after = at(spline.piece(k), 0.0);
    EXPECT_LT((before.first - after.first).norm(), 1e-9) << k;
    EXPECT_LT((before.second - after.second).norm(), 2e-8) << k;
  }
}

TEST(PositionSpline, TakesTheSlopesGivenForItsEnds) {
  const Track t = track();
  const Vector3 first_e(10.0, -20.0, 30.0), last_e(-1.0, 2.0, 3.0);
  const PositionSpline spline(t.points, t.intervals, {first_e, last_e});
  EXPECT_LT((at(spline.piece(0), 0.0).first - first_e).norm(), 1e-12);
  // Rounding of the cubic's terms, which are chords of 4 km over the interval.
  EXPECT_LT((at(spline.piece(10), t.intervals[10]).first - last_e).norm(), 1e-11);
}

TEST(PositionSpline, IsAParabolaThroughThreePointsAndALineThroughTwo) {
  // p(u) = p0 + a u + b u^2 in e, at uneven u.
  const Geodetic start = degrees(52.0, -7.0, 40.0);
  const Vector3 a(30.0, -12.0, 5.0), b(-2.0, 3.0, 0.5);
  const auto point = [&](double u) { return displaced(start, u * (a + u * b)); };
  const PositionSpline parabola({start, point(1.0), point(4.0)}, {1.0, 3.0}, {});
  // Angles in doubles place the points to 2e-9 m.
  EXPECT_LT((parabola.piece(0).c1_k - a).norm(), 1e-8);
  EXPECT_LT((parabola.piece(0).c2_k - b).norm(), 1e-8);
  EXPECT_LT(parabola.piece(0).c3_k.norm(), 1e-8);
  const PositionSpline line({start, point(1.0)}, {2.0}, {});
  EXPECT_LT((line.piece(0).c1_k - 0.5 * (a + b)).norm(), 1e-8);
  EXPECT_LT(line.piece(0).c2_k.norm(), 1e-8);
}

TEST(PositionSpline, FollowsASmoothCurveWithTheFourthPowerOfItsIntervals) {
  // A helix of 500 m radius; end slopes given. An interpolating cubic errs by 5/384 h^4 of the fourth derivative, R.
  const Geodetic centre = degrees(-10.0, -60.0, 0.0);
  const auto helix = [](double u) { return Vector3(500.0 * std::cos(u), 500.0 * std::sin(u), -20.0 * u); };
  const auto largest_error = [&](int n) {
    const double h = 2.0 / n;
    std::vector<Geodetic> points;
    for (int k = 0; k <= n; ++k) points.push_back(displaced(centre, helix(k * h)));
    const auto slope = [&](double u) -> Vector3 {
      return C_en_at(centre) * Vector3(-500.0 * std::sin(u), 500.0 * std::cos(u), -20.0);
    };
    const PositionSpline spline(points, std::vector<double>(n, h), {slope(0.0), slope(2.0)});
    double largest = 0.0;
    for (int k = 0; k < n; ++k) {
      const PositionPiece piece = spline.piece(k);
      for (const double part : {0.25, 0.5, 0.75}) {
        const Geodetic there = displaced(piece.origin, piece.displacement_k(part * h));
        largest = std::max(largest, ned_from(displaced(centre, helix((k + part) * h)), there).norm());
      }
    }
    return largest;
  };
  const double coarse = largest_error(20), fine = largest_error(40);
  EXPECT_LT(coarse, 5.0 / 384.0 * std::pow(0.1, 4) * 500.0);
  EXPECT_NEAR(coarse / fine, 16.0, 1.6);
}

TEST(PositionSpline, LosesNothingFarFromItsStart) {
  // Round the Earth along the equator in 2.8 deg steps: every piece is like the first.
  std::vector<Geodetic> points;
  for (int k = 0; k <= 256; ++k) points.push_back({0.0, wrapped_to_pi(2.0 * 3.14159265358979323846 * k / 256.0), 0.0});
  const PositionSpline spline(points, std::vector<double>(256, 100.0), {});
  const PositionPiece near = spline.piece(100), far = spline.piece(140);
  EXPECT_LT((near.c1_k - far.c1_k).norm(), 1e-10);
  EXPECT_LT((near.c2_k - far.c2_k).norm(), 1e-12);
}

TEST(PositionSpline, RefusesTooFewPointsAndIntervalsThatDoNotIncrease) {
  const Geodetic place = degrees(1.0, 2.0, 3.0);
  EXPECT_THROW(PositionSpline({place}, {}, {}), std::invalid_argument);
  EXPECT_THROW(PositionSpline({place, place}, {1.0, 1.0}, {}), std::invalid_argument);
  EXPECT_THROW(PositionSpline({place, place}, {0.0}, {}), std::invalid_argument);
}

}  // namespace position_spline_test
}  // namespace inslab::nav
