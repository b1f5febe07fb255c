#include "inslab/models/navigation/state_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::navigation {
namespace state_layout_test {

/// Each choice of blocks by a number below 16, and the parameters that make it.
constexpr unsigned kChoices = 16;
EstimatedErrors choice(unsigned bits) { return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0}; }

TEST(StateLayout, ByDefaultHasAll21StatesInTheirOrder) {
  const StateLayout layout{EstimatedErrors()};
  EXPECT_EQ(layout.size(), 21);
  Eigen::Index expected = 0;
  constexpr std::size_t kByDefault = 7;
  for (std::size_t i = 0; i < kByDefault; ++i, expected += 3) EXPECT_EQ(layout.first(StateBlock(i)), expected);
  for (std::size_t i = kByDefault; i < kBlocks.size(); ++i) EXPECT_FALSE(layout.has(StateBlock(i))) << kBlocks[i].name;
  EXPECT_EQ(layout.first(StateBlock::Position), kPosition);
  EXPECT_EQ(layout.first(StateBlock::Velocity), kVelocity);
  EXPECT_EQ(layout.first(StateBlock::Attitude), kAttitude);
}

TEST(StateLayout, ABlockThatIsLeftOutTakesNoPlace) {
  const StateLayout layout({false, true, false, true});
  EXPECT_EQ(layout.size(), 15);
  EXPECT_FALSE(layout.has(StateBlock::GyroBias) || layout.has(StateBlock::GyroScale));
  EXPECT_EQ(layout.first(StateBlock::AccelBias), 9);
  EXPECT_EQ(layout.first(StateBlock::AccelScale), 12);
  NavigationParameters p;
  p.states = {false, false, false, false};
  EXPECT_EQ(initial_sigmas(p).size(), 9);
}

constexpr double kDt_s = 0.01;
const nav::Gravity kGravity;

/// 30 s of turning and speeding up with fixes at 5 Hz, and rest before it.
NavSolution driven(const NavigationParameters& p, Eigen::Index& states) {
  nav::Strapdown truth({{0.53, 2.0, 50.0}, Vector3::Zero(), nav::Quaternion::Identity()}, kGravity, {true});
  NavigationFilter filter(p, kGravity);
  filter.start(truth.state(), 0);
  std::optional<NavSolution> solution;
  for (std::int64_t k = 1; k <= 3000; ++k) {
    const double t_s = kDt_s * static_cast<double>(k);
    const nav::NavState now = truth.state();
    const Matrix3 C_bn = nav::matrix_from_quaternion(now.q_nb).transpose();
    const Vector3 turn = t_s < 5.0 ? Vector3(0, 0, 0) : Vector3(0.01 * std::sin(t_s), 0.0, 0.3 * std::sin(0.5 * t_s));
    ImuSample sample;
    sample.dtheta_b = kDt_s * (C_bn * nav::omega_ie_n(now.position.latitude_rad) + turn);
    sample.dv_b = kDt_s * (Vector3(t_s < 5.0 ? 0.0 : 1.0, 0.0, 0.0) - C_bn * kGravity.g_n(now.position));
    truth.advance({sample.dtheta_b, sample.dv_b, kDt_s});
    sample.dtheta_b += kDt_s * Vector3(1e-5, -1e-5, 2e-5);
    sample.dv_b += kDt_s * Vector3(1e-3, 2e-3, -1e-3);
    sample.interval_ns = 10'000'000;
    sample.header.sim_time_ns = k * 10'000'000;
    solution = filter.add(sample);
    if (k % 20 != 0) continue;
    const nav::NavState there = truth.state();
    GnssFix fix;
    fix.header.sim_time_ns = sample.header.sim_time_ns;
    fix.fix_type = FixType::Fixed;
    fix.latitude_rad = there.position.latitude_rad;
    fix.longitude_rad = there.position.longitude_rad;
    fix.height_m = there.position.height_m;
    fix.v_n = there.v_n;
    fix.position_sigma_ned_m.setConstant(0.02);
    fix.velocity_sigma_ned_m_per_s.setConstant(0.03);
    filter.add(fix);
  }
  states = filter.filter()->covariance().size();
  return *solution;
}

// An error that the filter holds for exactly known, sigma 0, is never corrected: the same answer, at a larger size.
TEST(StateLayout, ABlockThatIsLeftOutIsOneThatIsHeldForZero) {
  for (unsigned bits = 0; bits < kChoices; ++bits) {
    NavigationParameters left_out, held;
    left_out.states = choice(bits);
    if (!left_out.states.gyro_bias) held.gyro.bias_sigma_deg_per_h.setZero();
    if (!left_out.states.accel_bias) held.accel.bias_sigma_mgal.setZero();
    if (!left_out.states.gyro_scale_factor) held.gyro.scale_factor_sigma_ppm.setZero();
    if (!left_out.states.accel_scale_factor) held.accel.scale_factor_sigma_ppm.setZero();
    Eigen::Index states = 0, all = 0;
    const NavSolution a = driven(left_out, states), b = driven(held, all);
    EXPECT_EQ(states, StateLayout(choice(bits)).size());
    EXPECT_EQ(all, 21);
    EXPECT_NEAR(a.height_m, b.height_m, 1e-9) << bits;
    EXPECT_NEAR(a.latitude_rad, b.latitude_rad, 1e-15) << bits;
    EXPECT_LT((a.v_n - b.v_n).norm(), 1e-10) << bits;
    EXPECT_LT((a.position_sigma_ned_m - b.position_sigma_ned_m).norm(), 1e-10) << bits;
    EXPECT_LT((a.attitude_sigma_rad - b.attitude_sigma_rad).norm(), 1e-12) << bits;
  }
}

}  // namespace state_layout_test
}  // namespace inslab::navigation
