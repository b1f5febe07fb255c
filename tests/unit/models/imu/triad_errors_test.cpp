#include "inslab/models/imu/triad_errors.hpp"

#include <gtest/gtest.h>

namespace inslab::imu {
namespace triad_errors_test {

TriadErrors triad(const TriadParameters& parameters) { return {parameters, 0.005, 77, "imu0/gyro", "arw"}; }

TriadErrorBudget errors_of(TriadErrors& errors, const Vector3& perfect, const Vector3& vibration, std::uint64_t k) {
  TriadErrorBudget budget;
  errors.add_errors(perfect, vibration, 0.0, {k, 0.005, 1.0}, budget);
  return budget;
}

TEST(TriadErrors, ScaleAndCrossAxisActOnTruthAndVibrationTogether) {
  TriadParameters parameters;
  parameters.scale_factor.setConstant(0.1);
  parameters.cross_axis_rad[0] = 0.01;
  TriadErrors errors = triad(parameters);
  const TriadErrorBudget budget = errors_of(errors, {1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0);
  EXPECT_DOUBLE_EQ(budget.scale.x(), 0.2);
  EXPECT_DOUBLE_EQ(budget.cross_axis.y(), 0.02);
  EXPECT_EQ(budget.vibration, Vector3(1.0, 0.0, 0.0));
  EXPECT_EQ(budget.noise, Vector3::Zero());
  EXPECT_EQ(budget.bias, Vector3::Zero());
}

TEST(TriadErrors, NonlinearityIsBookedAsScale) {
  TriadParameters parameters;
  parameters.scale_factor.setConstant(0.1);
  parameters.scale_factor_asymmetry.setConstant(0.2);
  TriadErrors errors = triad(parameters);
  EXPECT_DOUBLE_EQ(errors_of(errors, {-1.0, 0.0, 0.0}, Vector3::Zero(), 0).scale.x(), -0.1 + 0.1);
}

TEST(TriadErrors, ChangingOneTermLeavesTheDrawsOfTheOthersAlone) {
  TriadParameters noise_only;
  noise_only.random_walk.setConstant(1e-3);
  TriadParameters both = noise_only;
  both.bias_gm_sigma.setConstant(1.0);
  both.bias_gm_correlation_time_s.setConstant(100.0);
  both.bias_random_walk.setConstant(1.0);
  both.bias_instability.setConstant(1.0);
  both.scale_factor_gm_sigma.setConstant(1e-3);
  both.scale_factor_gm_correlation_time_s.setConstant(100.0);
  TriadErrors a = triad(noise_only), b = triad(both);
  for (std::uint64_t k = 0; k < 20; ++k) {
    EXPECT_EQ(errors_of(a, Vector3::Zero(), Vector3::Zero(), k).noise,
              errors_of(b, Vector3::Zero(), Vector3::Zero(), k).noise);
  }
}

}  // namespace triad_errors_test
}  // namespace inslab::imu
