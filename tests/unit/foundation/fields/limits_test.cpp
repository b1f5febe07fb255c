#include "inslab/foundation/fields/limits.hpp"

#include <gtest/gtest.h>

#include "inslab/data/catalog/any_profile.hpp"
#include "tests/unit/foundation/fields/number_fields.hpp"

namespace inslab {
namespace limits_test {

template <class Profile>
class LimitsOf : public testing::Test {};

using Profiles = Applied<testing::Types, catalog::ProfileKinds>;
TYPED_TEST_SUITE(LimitsOf, Profiles, );

template <class Profile>
Profile valid_profile() {
  Profile profile;
  test::ValidFiller filler;
  Profile::fields(profile, filler);
  return profile;
}

TYPED_TEST(LimitsOf, AreKeptByAFilledProfile) {
  const auto profile = valid_profile<TypeParam>();
  EXPECT_FALSE(limit_violation(profile).has_value());
}

TYPED_TEST(LimitsOf, EveryNumberJustOutsideIsNamedAndTheEndsAreInside) {
  auto profile = valid_profile<TypeParam>();
  test::NumberFinder finder(true);
  TypeParam::fields(profile, finder);
  int touched = 0;
  for (const test::NumberField& number : finder.found) {
    if (number.value == nullptr) continue;
    const double valid = *number.value;
    for (const double inside : {number.minimum, number.maximum}) {
      *number.value = inside;
      EXPECT_FALSE(limit_violation(profile).has_value()) << number.path << " = " << inside;
    }
    for (const double outside : {std::nextafter(number.minimum, -INFINITY), std::nextafter(number.maximum, INFINITY),
                                 std::nan(""), HUGE_VAL}) {
      *number.value = outside;
      const auto broken = limit_violation(profile);
      ASSERT_TRUE(broken.has_value()) << number.path << " = " << outside;
      EXPECT_EQ(broken->path, number.path);
      EXPECT_EQ(broken->rule, Rule::ValueRange);
      EXPECT_NE(broken->reason.find("expected"), std::string::npos) << broken->reason;
    }
    *number.value = valid;
    ++touched;
  }
  EXPECT_GE(touched, 6);
}

TEST(Limits, BoundTextsAndLists) {
  InstallationProfile named;
  named.name = std::string(64, 'n');
  EXPECT_FALSE(limit_violation(named).has_value());
  named.name += 'n';
  ASSERT_TRUE(limit_violation(named).has_value());
  EXPECT_EQ(limit_violation(named)->rule, Rule::BoundedSize);
  EXPECT_EQ(limit_violation(named)->path, "name");

  VibrationProfile shaking;
  shaking.linear.assign(17, valid_profile<VibrationProfile>().linear.front());
  ASSERT_TRUE(limit_violation(shaking).has_value());
  EXPECT_EQ(limit_violation(shaking)->rule, Rule::BoundedSize);
  EXPECT_EQ(limit_violation(shaking)->path, "linear");
}

TEST(Limits, NameTheElementOfAList) {
  VibrationProfile shaking;
  shaking.linear.assign(3, valid_profile<VibrationProfile>().linear.front());
  shaking.linear[2].frequency_hz = 0.0;
  ASSERT_TRUE(limit_violation(shaking).has_value());
  EXPECT_EQ(limit_violation(shaking)->path, "linear[2].frequency_hz");
}

TEST(Limits, OfWholeNumbersHold) {
  GnssErrorProfile profile;
  profile.satellites = 200;
  EXPECT_FALSE(limit_violation(profile).has_value());
  profile.satellites = 201;
  ASSERT_TRUE(limit_violation(profile).has_value());
  EXPECT_EQ(limit_violation(profile)->path, "satellites");
}

}  // namespace limits_test
}  // namespace inslab
