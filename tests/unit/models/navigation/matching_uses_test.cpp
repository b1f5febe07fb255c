#include "inslab/models/navigation/matching_uses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/models/navigation/matching_parameters.hpp"
#include "tests/unit/data/field_changer.hpp"

namespace inslab::navigation::matching {
namespace matching_uses_test {

// A new term of a profile is handled, or it is named as left out: there is no third.
TEST(MatchedProfiles, SaysOfEveryFieldOfEveryProfileWhatBecomesOfIt) {
  const std::string file = "common/models/navigation/matching_uses.hpp";
  for_each(catalog::ProfileKinds{}, [&file](auto kind) {
    EXPECT_EQ(profiles::faults_of<typename decltype(kind)::type>(uses_of(kind), file), "");
  });
}

Eigen::Matrix<double, 30, 1> figures(const NavigationParameters& p) {
  Eigen::Matrix<double, 30, 1> all;
  all << p.gyro.arw_deg_per_sqrt_h, p.gyro.bias_sigma_deg_per_h, p.gyro.bias_correlation_time_s,
      p.gyro.scale_factor_sigma_ppm, p.gyro.scale_factor_correlation_time_s, p.accel.vrw_m_per_s_per_sqrt_h,
      p.accel.bias_sigma_mgal, p.accel.bias_correlation_time_s, p.accel.scale_factor_sigma_ppm,
      p.accel.scale_factor_correlation_time_s;
  return all;
}

// Between two corners the course of the temperature is a line, so it matters how far it leads, and not when.
TEST(MatchedProfiles, WhatIsSaidToBeHandledChangesTheParametersAndNothingElseDoes) {
  ImuErrorProfile all;
  all.temperature = {{0.0, 20.0}, {100.0, 60.0}};
  const auto entries = profiles::detail::numbers_of(all);
  for (const auto& entry : entries) {
    if (entry.path.find("temperature[]") == 0) continue;
    test::FieldChanger set(entry.path, 2.0);
    ImuErrorProfile::fields(all, set);
  }
  const auto before = figures(matching_parameters(all, {}, {}));
  for (const auto& entry : entries) {
    if (entry.path == "temperature[].at_s") continue;
    ImuErrorProfile changed = all;
    test::FieldChanger change(entry.path, 3.0);
    ImuErrorProfile::fields(changed, change);
    const bool changes = figures(matching_parameters(changed, {}, {})) != before;
    const bool handled = profiles::detail::use_of(kImuErrorUses, entry.path)->what == profiles::FieldUse::What::Handled;
    EXPECT_EQ(changes, handled) << entry.path;
  }
}

TEST(MatchedProfiles, WhatIsSetAndLeftOutIsNamed) {
  ImuErrorProfile errors;
  errors.gyro.arw_deg_per_sqrt_h.setConstant(0.1);
  EXPECT_TRUE(left_out_of_matching(errors).empty());
  errors.accel.quantization_m_per_s.setConstant(1e-5);
  errors.gyro.bandwidth_hz.setConstant(50.0);
  errors.accel.nonlinearity_ppm_per_g.setConstant(10.0);
  EXPECT_THAT(left_out_of_matching(errors),
              testing::ElementsAre("bandwidth", "non-linearity by the force", "quantization"));
  VibrationProfile vibration;
  EXPECT_TRUE(left_out_of_matching(vibration).empty());
  vibration.linear.emplace_back();
  EXPECT_THAT(left_out_of_matching(vibration), testing::ElementsAre("vibration"));
}

}  // namespace matching_uses_test
}  // namespace inslab::navigation::matching
