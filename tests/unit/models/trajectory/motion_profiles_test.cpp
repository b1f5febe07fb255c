#include "inslab/models/trajectory/motion_profiles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace inslab::trajectory {
namespace motion_profiles_test {

/// Gauss-Legendre with three points on 256 pieces between corners: exact for the polynomials here, and for a sinusoid
/// over a 256th of the span good to 1e-13.
template <class Profile>
double numerical_integral(const Profile& profile, double end_s) {
  std::vector<double> stops{0.0};
  for (const double corner : profile.corners()) {
    if (corner < end_s) stops.push_back(corner);
  }
  stops.push_back(end_s);
  double sum = 0.0;
  for (std::size_t i = 1; i < stops.size(); ++i) {
    const double piece = (stops[i] - stops[i - 1]) / 256.0;
    for (int j = 0; j < 256; ++j) {
      const double middle = stops[i - 1] + (j + 0.5) * piece, arm = 0.5 * piece * std::sqrt(0.6);
      sum += piece / 18.0 *
             (5.0 * profile.value(middle - arm) + 8.0 * profile.value(middle) + 5.0 * profile.value(middle + arm));
    }
  }
  return sum;
}

template <class Profile>
void expect_integral_is_that_of_the_value(const Profile& profile, double duration_s) {
  for (int i = 0; i <= 40; ++i) {
    const double t_s = duration_s * i / 40.0;
    EXPECT_NEAR(profile.integral(t_s), numerical_integral(profile, t_s), 2e-12) << t_s;
  }
}

TEST(MotionProfiles, IntegralsAreThoseOfTheValues) {
  expect_integral_is_that_of_the_value(ConstantProfile(-2.0), 7.0);
  expect_integral_is_that_of_the_value(RampProfile(1.0, -3.0, 7.0), 7.0);
  expect_integral_is_that_of_the_value(SinusoidProfile(SinusoidProfile::Phase::Sine, 1.5, 3.0), 7.0);
  expect_integral_is_that_of_the_value(SinusoidProfile(SinusoidProfile::Phase::Cosine, 1.5, 3.0), 7.0);
  expect_integral_is_that_of_the_value(TrapezoidProfile(12.0, 7.0, 0.2), 7.0);
  expect_integral_is_that_of_the_value(TrapezoidProfile(12.0, 7.0, 0.5), 7.0);
  expect_integral_is_that_of_the_value(TurnProfile(-1.6, 7.0, 0.3), 7.0);
  expect_integral_is_that_of_the_value(TurnProfile(-1.6, 7.0, 0.5), 7.0);
}

TEST(MotionProfiles, TrapezoidBeginsAndEndsAtRest) {
  const TrapezoidProfile trapezoid(12.0, 8.0, 0.25);
  EXPECT_EQ(trapezoid.value(0.0), 0.0);
  EXPECT_EQ(trapezoid.value(8.0), 0.0);
  EXPECT_EQ(trapezoid.integral(8.0), 12.0);
  EXPECT_DOUBLE_EQ(trapezoid.value(4.0), 2.0);  // 12/(8 - 2)
}

TEST(MotionProfiles, TurnHasThePeakOfTheThesis) {
  // (3-12): theta = k t1^2 (t - t1)/4, so the top rate k t1^2/4 is theta/(t - t1).
  const TurnProfile turn(3.0, 8.0, 0.25);
  EXPECT_DOUBLE_EQ(turn.value(4.0), 0.5);
  EXPECT_EQ(turn.value(0.0), 0.0);
  EXPECT_EQ(turn.value(8.0), 0.0);
  EXPECT_EQ(turn.integral(8.0), 3.0);
}

TEST(MotionProfiles, TurnPassesThePiecesOfTheThesis) {
  // (3-11): angles gained by t1/2 and between t1/2 and t1 are k t1^3/48 and 5 k t1^3/48.
  const double t = 10.0, A = 0.3, theta = 2.0, t1 = A * t;
  const double k = 4.0 * theta / (t * t * t * A * A * (1.0 - A));
  const TurnProfile turn(theta, t, A);
  EXPECT_NEAR(turn.integral(t1 / 2), k * t1 * t1 * t1 / 48.0, 1e-15);
  EXPECT_NEAR(turn.integral(t1), k * t1 * t1 * t1 / 8.0, 1e-15);
  EXPECT_NEAR(turn.integral(t - t1), k * t1 * t1 * t / 4.0 - 3.0 / 8.0 * k * t1 * t1 * t1, 1e-14);
}

TEST(MotionProfiles, ValuesAreContinuousAtCorners) {
  const TrapezoidProfile trapezoid(12.0, 7.0, 0.2);
  const TurnProfile turn(1.6, 7.0, 0.3);
  const double hair_s = 1e-12;  // times slopes below 10
  for (const double corner : trapezoid.corners()) {
    EXPECT_NEAR(trapezoid.value(corner - hair_s), trapezoid.value(corner + hair_s), 1e-10);
  }
  for (const double corner : turn.corners()) {
    EXPECT_NEAR(turn.value(corner - hair_s), turn.value(corner + hair_s), 1e-10);
  }
}

TEST(MotionProfiles, SinusoidComesBackAfterAPeriod) {
  const SinusoidProfile sine(SinusoidProfile::Phase::Sine, 2.0, 4.0);
  EXPECT_DOUBLE_EQ(sine.value(1.0), 2.0);
  EXPECT_NEAR(sine.integral(4.0), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(sine.integral(2.0), 2.0 * 4.0 / 3.14159265358979323846);
  const SinusoidProfile cosine(SinusoidProfile::Phase::Cosine, 2.0, 4.0);
  EXPECT_DOUBLE_EQ(cosine.value(0.0), 2.0);
  EXPECT_NEAR(cosine.integral(2.0), 0.0, 1e-15);
}

}  // namespace motion_profiles_test
}  // namespace inslab::trajectory
