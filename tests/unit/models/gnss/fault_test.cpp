#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/models/gnss/receiver.hpp"

namespace inslab::gnss {
namespace fault_test {

using namespace test;

FaultProfile of_a_receiver() {
  FaultProfile fault;
  fault.target.kind = SensorKind::Gnss;
  return fault;
}

GnssModel::Setup noisy_receiver() {
  GnssModel::Setup s = setup();
  s.errors.fix_type = FixType::Fixed;
  s.errors.position_sigma_ned_m.setConstant(0.5);
  return s;
}

TEST(GnssFaults, AWrongFixTypeIsClaimedWhileItIsOnAndNothingElseChanges) {
  GnssModel right(noisy_receiver()), wrong(noisy_receiver());
  FaultProfile fault = of_a_receiver();
  fault.wrong_fix_type = FixType::Single;
  for (std::int64_t k = 1; k <= 30; ++k) {
    if (k == 11) wrong.apply(fault);
    if (k == 21) wrong.apply(of_a_receiver());
    const auto expected = right.observe(at_rest(k * 200000000)), shown = wrong.observe(at_rest(k * 200000000));
    ASSERT_EQ(shown->fix_type, k > 10 && k <= 20 ? FixType::Single : FixType::Fixed) << k;
    ASSERT_EQ(shown->latitude_rad, expected->latitude_rad);
    ASSERT_EQ(shown->position_sigma_ned_m, expected->position_sigma_ned_m);
  }
}

/// The mean square of n draws is within five standard errors, sigma^2 sqrt(2/n), of sigma^2. Before and after, the
/// receiver's own noise is as without.
TEST(GnssFaults, ABurstAddsWhiteNoiseOfItsSigmaInMetresAndEndsWithoutATrace) {
  GnssModel quiet(noisy_receiver()), loud(noisy_receiver());
  FaultProfile fault = of_a_receiver();
  fault.position_noise_burst_ned_m = Vector3(3.0, 0.0, 7.0);
  constexpr std::int64_t kFixes = 4000;
  Vector3 squares_m2 = Vector3::Zero();
  for (std::int64_t k = 1; k <= kFixes + 20; ++k) {
    if (k == 11) loud.apply(fault);
    if (k == kFixes + 11) loud.apply(of_a_receiver());
    const TruthState truth = at_rest(k * 200000000);
    const auto expected = quiet.observe(truth), shown = loud.observe(truth);
    const Vector3 burst_m = position_error_ned(*shown, truth) - position_error_ned(*expected, truth);
    if (k > 10 && k <= kFixes + 10) {
      squares_m2 += burst_m.cwiseAbs2();
    } else {
      ASSERT_EQ(shown->latitude_rad, expected->latitude_rad) << k;
      ASSERT_EQ(shown->height_m, expected->height_m) << k;
    }
  }
  const double relative = 5.0 * std::sqrt(2.0 / kFixes);
  EXPECT_NEAR(squares_m2.x() / kFixes, 9.0, 9.0 * relative);
  EXPECT_LT(squares_m2.y() / kFixes, 1e-16);
  EXPECT_NEAR(squares_m2.z() / kFixes, 49.0, 49.0 * relative);
}

}  // namespace fault_test
}  // namespace inslab::gnss
