#include "inslab/nav/rotation_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "inslab/nav/attitude.hpp"

namespace inslab::nav {
namespace rotation_spline_test {

struct Turns {
  std::vector<Quaternion> q;
  std::vector<double> intervals_s;
};

/// Rotations about changing axes, each at most `angle_rad` from the one before, with signs and intervals at random.
Turns random_turns(double angle_rad, int count) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Turns turns;
  Quaternion q = Quaternion::Identity();
  for (int k = 0; k < count; ++k) {
    const Vector3 axis(uniform(engine), uniform(engine), uniform(engine));
    q = q * quaternion_from_rotation_vector(angle_rad * uniform(engine) * axis.normalized());
    turns.q.push_back(k % 2 == 0 ? q : Quaternion(-q.coeffs()));
    if (k > 0) turns.intervals_s.push_back(0.6 + 0.5 * uniform(engine));
  }
  return turns;
}

/// The angular acceleration by one-sided differences, five points inside the piece.
Vector3 acceleration(const RotationPiece& piece, double t_s, double h) {
  const auto w = [&](int i) { return piece.omega_ab_b(t_s + i * h); };
  return (-25.0 * w(0) + 48.0 * w(1) - 36.0 * w(2) + 16.0 * w(3) - 3.0 * w(4)) / (12.0 * h);
}

class RotationSplineOf : public testing::TestWithParam<double> {};

TEST_P(RotationSplineOf, PassesThroughItsRotations) {
  const Turns turns = random_turns(GetParam(), 200);
  const RotationSpline spline(turns.q, turns.intervals_s);
  for (std::size_t k = 0; k < spline.pieces(); ++k) {
    const RotationPiece piece = spline.piece(k);
    EXPECT_LT(angle_between(piece.q_ab(0.0), turns.q[k]), 1e-15);
    EXPECT_LT(angle_between(piece.q_ab(turns.intervals_s[k]), turns.q[k + 1]), 1e-14) << k;
  }
}

TEST_P(RotationSplineOf, HasContinuousRateAndAcceleration) {
  const Turns turns = random_turns(GetParam(), 200);
  const RotationSpline spline(turns.q, turns.intervals_s);
  for (std::size_t k = 1; k < spline.pieces(); ++k) {
    const RotationPiece before = spline.piece(k - 1), after = spline.piece(k);
    const double end_s = turns.intervals_s[k - 1];
    EXPECT_LT((before.omega_ab_b(end_s) - after.omega_ab_b(0.0)).norm(), 1e-12) << k;
    // The differences leave h^4/5 of the rate's fifth derivative, up to 50 rad/s over (0.05 s)^5 on the shortest piece,
    // and 1e-15 of the rate over h.
    EXPECT_LT((acceleration(before, end_s, -2e-4) - acceleration(after, 0.0, 2e-4)).norm(), 1e-6) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, RotationSplineOf, testing::Values(0.01, 0.3, 1.5), [](const auto& angle) {
  return "UpTo" + std::to_string(int(100 * angle.param)) + "CentiRad";
});

TEST(RotationSpline, RateIsTheDerivativeOfTheRotation) {
  const Turns turns = random_turns(1.0, 20);
  const RotationSpline spline(turns.q, turns.intervals_s);
  for (std::size_t k = 0; k < spline.pieces(); ++k) {
    const RotationPiece piece = spline.piece(k);
    for (const double part : {0.1, 0.5, 0.8}) {
      const double t_s = part * turns.intervals_s[k], h = 1e-4;
      // The rotation vector over 2 h centred on t is 2 h omega but for h^3/3 of omega'' and of (omega x omega')/2.
      const Vector3 turned = rotation_vector_from_quaternion(piece.q_ab(t_s - h).conjugate() * piece.q_ab(t_s + h));
      EXPECT_LT((turned / (2.0 * h) - piece.omega_ab_b(t_s)).norm(), 1e-6) << k;
    }
  }
}

TEST(RotationSpline, KeepsAConstantRateAboutOneAxis) {
  const Vector3 rate_rad_per_s(0.2, -0.3, 0.9);
  std::vector<Quaternion> q;
  for (int k = 0; k < 30; ++k) q.push_back(canonical(quaternion_from_rotation_vector(0.5 * k * rate_rad_per_s)));
  const RotationSpline spline(q, std::vector<double>(29, 0.5));
  for (std::size_t k = 0; k < spline.pieces(); ++k) {
    EXPECT_LT((spline.piece(k).omega_ab_b(0.3) - rate_rad_per_s).norm(), 1e-13);
  }
}

TEST(RotationSpline, StaysAtRestExactly) {
  const Quaternion q = quaternion_from_rpy({0.1, 0.2, 0.3});
  const RotationSpline spline({q, q, q}, {1.0, 2.0});
  EXPECT_EQ(spline.piece(1).omega_ab_b(1.0), Vector3::Zero());
}

TEST(RotationSpline, FollowsASmoothRotationWithTheFourthPowerOfItsIntervals) {
  // Coning: roll and pitch swing by 0.3 rad a quarter period apart while yaw runs on. Whole swings away from the ends.
  const auto attitude = [](double t_s) {
    return quaternion_from_rpy({0.3 * std::sin(t_s), 0.3 * std::cos(t_s), 0.4 * t_s});
  };
  const auto largest_error = [&](int n) {
    const double h = 20.0 / n;
    std::vector<Quaternion> q;
    for (int k = 0; k <= n; ++k) q.push_back(attitude(k * h));
    const RotationSpline spline(q, std::vector<double>(n, h));
    double largest = 0.0;
    for (int k = n / 4; k < 3 * n / 4; ++k) {
      largest = std::max(largest, angle_between(spline.piece(k).q_ab(0.5 * h), attitude((k + 0.5) * h)));
    }
    return largest;
  };
  const double coarse = largest_error(100), fine = largest_error(200);
  EXPECT_LT(coarse, 5e-6);
  EXPECT_NEAR(coarse / fine, 16.0, 1.6);
}

TEST(RotationSpline, RefusesWhatDoesNotFitTogether) {
  const Quaternion q = Quaternion::Identity();
  EXPECT_THROW(RotationSpline({q}, {}), std::invalid_argument);
  EXPECT_THROW(RotationSpline({q, q}, {-1.0}), std::invalid_argument);
}

TEST(RotationFactors, JoinTheirSeriesToTheirClosedForms) {
  for (const double phi : {0.0, 1e-8, 0.0999999, 0.1000001, 1.0, 3.0}) {
    const RotationFactors factors(phi * phi);
    const long double x = phi;
    const long double small = x == 0.0L ? 1.0L : std::sin(x) / x;
    EXPECT_NEAR(factors.S, static_cast<double>(small), 2e-16);
    if (phi < 1e-3) continue;
    EXPECT_NEAR(factors.A, static_cast<double>((1.0L - std::cos(x)) / (x * x)), 1e-16) << phi;
    EXPECT_NEAR(factors.B, static_cast<double>((x - std::sin(x)) / (x * x * x)), 1e-14) << phi;
  }
}

}  // namespace rotation_spline_test
}  // namespace inslab::nav
