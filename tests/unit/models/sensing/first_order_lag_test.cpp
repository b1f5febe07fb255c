#include "inslab/models/sensing/first_order_lag.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::sensing {
namespace first_order_lag_test {

constexpr std::int64_t kStepNs = 20'000'000;
constexpr double kStepS = 0.02, kT = 0.3;

TEST(FirstOrderLag, BeginsSettledAndWithoutATimeConstantIsTheQuantity) {
  FirstOrderLag lag;
  EXPECT_EQ(lag.follow(0, 5.0, kT), 5.0);
  EXPECT_EQ(lag.follow(kStepNs, 9.0, 0.0), 9.0);
}

TEST(FirstOrderLag, IsBehindARampByItsTimeConstantInTheEnd) {
  // y = a (t - T + T e^(-t/T)) of x = a t.
  FirstOrderLag lag;
  for (int k = 0; k <= 200; ++k) {
    const double t_s = k * kStepS;
    EXPECT_NEAR(lag.follow(k * kStepNs, 7.0 * t_s, kT), 7.0 * (t_s - kT + kT * std::exp(-t_s / kT)), 1e-12) << k;
  }
}

TEST(FirstOrderLag, AJumpIsAnsweredFromTheMomentBefore) {
  FirstOrderLag lag;
  lag.jump(3.0);  // of nothing
  EXPECT_EQ(lag.follow(0, 100.0, kT), 100.0);
  lag.jump(40.0);
  for (int k = 1; k <= 50; ++k) {
    EXPECT_NEAR(lag.follow(k * kStepNs, 40.0, kT), 40.0 + 60.0 * std::exp(-k * kStepS / kT), 1e-12) << k;
  }
}

TEST(FirstOrderLag, HeldItStaysAndGoesOnFromThere) {
  FirstOrderLag lag;
  EXPECT_EQ(lag.hold(0, 12.0), 12.0);
  EXPECT_EQ(lag.hold(kStepNs, 80.0), 12.0);
  // From 12 to 80 in a straight line of one step.
  const double slope = 68.0 / kStepS;
  EXPECT_NEAR(lag.follow(2 * kStepNs, 80.0, kT), 80.0 - kT * slope * (1.0 - std::exp(-kStepS / kT)), 1e-12);
}

}  // namespace first_order_lag_test
}  // namespace inslab::sensing
