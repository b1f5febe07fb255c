#include "inslab/models/air_data/dryden_gusts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

/// The gusts against Dryden's correlations, over many seeds. Products of two unit Gaussian numbers of the correlation R
/// have the variance 1 + R^2, so a mean of N of them is within 4 sqrt((1 + R^2)/N).
namespace inslab::air_data {
namespace dryden_gusts_test {

constexpr int kSeeds = 20000;

double longitudinal(double way) { return std::exp(-way); }
double transverse(double way) { return std::exp(-way) * (1.0 - 0.5 * way); }

/// Mean of the products of a gust's first value and the one after `way`, gone in so many steps.
template <class Gust>
double correlation(double way, int steps) {
  double sum = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    Gust gust(random::Stream(static_cast<std::uint64_t>(seed), "gust"));
    const double first = gust.value();
    for (int k = 1; k <= steps; ++k) gust.advance(static_cast<std::uint64_t>(k), way / steps);
    sum += first * gust.value();
  }
  return sum / kSeeds;
}

double four_sigma(double correlation) { return 4.0 * std::sqrt((1.0 + correlation * correlation) / kSeeds); }

TEST(DrydenGusts, AlongTheirSpectrumDecorrelateAsAnExponential) {
  for (const double way : {0.0, 0.3, 1.0, 2.5}) {
    for (const int steps : {1, 12}) {
      EXPECT_NEAR(correlation<LongitudinalGust>(way, steps), longitudinal(way), four_sigma(longitudinal(way)))
          << way << " " << steps;
    }
  }
}

TEST(DrydenGusts, AcrossItTurnOverAfterTwoLengths) {
  for (const double way : {0.0, 0.3, 1.0, 2.0, 4.0}) {
    for (const int steps : {1, 12}) {
      EXPECT_NEAR(correlation<TransverseGust>(way, steps), transverse(way), four_sigma(transverse(way)))
          << way << " " << steps;
    }
  }
}

/// Variance of the value at the end, and of the mean over the way.
template <class Gust>
std::pair<double, double> spreads(int seeds, int steps, double step) {
  double ends = 0.0, means = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    Gust gust(random::Stream(static_cast<std::uint64_t>(seed), "gust"));
    double sum = 0.0;
    for (int k = 1; k <= steps; ++k) {
      gust.advance(static_cast<std::uint64_t>(k), step);
      sum += gust.value();
    }
    ends += gust.value() * gust.value();
    means += sum / steps * sum / steps;
  }
  return {ends / seeds, means / seeds};
}

TEST(DrydenGusts, KeepTheirVarianceAndHaveTheirIntegralScales) {
  // The variance of a mean over S lengths is 2/S^2 times the integral of (S - s) R(s): (2/S^2)(S - 1 + e^-S) and, as
  // the first moment of the transverse correlation is 0, 1/S (1 - O(e^-S)). Of N seeds a variance is within
  // 4 sqrt(2/N); sums in steps of 0.05 are within 1e-3 of the integrals.
  constexpr int kOfThem = 4000, kSteps = 400;
  constexpr double kStep = 0.05, kWay = kSteps * kStep;
  const double tolerance = 4.0 * std::sqrt(2.0 / kOfThem) + 1e-3;
  const auto along = spreads<LongitudinalGust>(kOfThem, kSteps, kStep);
  EXPECT_NEAR(along.first, 1.0, tolerance);
  const double of_mean = 2.0 / (kWay * kWay) * (kWay - 1.0);
  EXPECT_NEAR(along.second, of_mean, tolerance * of_mean);
  const auto across = spreads<TransverseGust>(kOfThem, kSteps, kStep);
  EXPECT_NEAR(across.first, 1.0, tolerance);
  EXPECT_NEAR(across.second, 1.0 / kWay, tolerance / kWay);
}

TEST(DrydenGusts, AreSmoothOnTheSmallestWays) {
  // Over a way s their change has the variance 2 (1 - R) = 3 s to first order across and 2 s along, down to ways where
  // the noise's covariance is lost in a difference of 1 and the exponential's first terms.
  constexpr double kWay = 1e-7;
  double across = 0.0, along = 0.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const random::Stream stream(static_cast<std::uint64_t>(seed), "gust");
    TransverseGust v(stream);
    LongitudinalGust u(stream);
    const double v0 = v.value(), u0 = u.value();
    v.advance(1, kWay);
    u.advance(1, kWay);
    across += std::pow(v.value() - v0, 2.0) / kSeeds;
    along += std::pow(u.value() - u0, 2.0) / kSeeds;
  }
  const double tolerance = 4.0 * std::sqrt(2.0 / kSeeds);
  EXPECT_NEAR(across, 3.0 * kWay, 3.0 * kWay * tolerance);
  EXPECT_NEAR(along, 2.0 * kWay, 2.0 * kWay * tolerance);
}

TEST(DrydenGusts, WithoutWayStandStill) {
  TransverseGust v(random::Stream(4, "gust"));
  LongitudinalGust u(random::Stream(4, "gust"));
  const double v0 = v.value(), u0 = u.value();
  v.advance(1, 0.0);
  u.advance(1, 0.0);
  EXPECT_EQ(v.value(), v0);
  EXPECT_EQ(u.value(), u0);
}

TEST(DrydenGusts, HaveTheLengthsAndSpreadsOfTheirHeight) {
  // 20 ft up in light turbulence the vertical length is 6.096 m and the others 43.77 m: after 6.096 m the vertical
  // gust's correlation is e^-1/2, that of the others nearly their whole variance.
  WindField wind;
  wind.turbulence = Turbulence::Light;
  wind.turbulence_scale = 2.0;
  const Vector3 sigma = 2.0 * Vector3(1.488652, 1.488652, 0.771667);
  const double way_m = 6.096, along = 6.096 / 43.7659;
  Vector3 variance = Vector3::Zero(), product = Vector3::Zero();
  for (int seed = 0; seed < kSeeds; ++seed) {
    DrydenGusts gusts(random::Stream(static_cast<std::uint64_t>(seed), "air/gust"));
    const Vector3 first = gusts.advance(1, wind, 6.096, 0.0);
    const Vector3 second = gusts.advance(2, wind, 6.096, way_m);
    variance += second.cwiseAbs2() / kSeeds;
    product += first.cwiseProduct(second) / kSeeds;
  }
  const Vector3 expected(longitudinal(along), transverse(along), 0.5 * std::exp(-1.0));
  for (int axis = 0; axis < 3; ++axis) {
    const double power = sigma[axis] * sigma[axis];
    EXPECT_NEAR(variance[axis], power, power * four_sigma(1.0)) << axis;
    EXPECT_NEAR(product[axis], power * expected[axis], power * four_sigma(expected[axis])) << axis;
  }
}

TEST(DrydenGusts, OfCalmAirAreNone) {
  DrydenGusts gusts(random::Stream(1, "air/gust"));
  EXPECT_TRUE(gusts.advance(1, {}, 100.0, 5.0).isZero(0.0));
  WindField wind;
  wind.turbulence = Turbulence::Severe;
  wind.turbulence_scale = 0.0;
  EXPECT_TRUE(gusts.advance(2, wind, 100.0, 5.0).isZero(0.0));
}

}  // namespace dryden_gusts_test
}  // namespace inslab::air_data
