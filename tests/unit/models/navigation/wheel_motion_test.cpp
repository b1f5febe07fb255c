#include "inslab/models/navigation/wheel_motion.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "inslab/models/navigation/measurements.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "tests/unit/models/navigation/rolling_wheel.hpp"

namespace inslab::navigation {
namespace wheel_motion_test {

using namespace circling;

/// A filter that has followed the truth to the end of an odometer's interval from a start that errs by `e`.
struct AtTheEnd {
  NavigationParameters p;
  Circling truth;
  InertialFilter filter;

  AtTheEnd(const NavigationParameters& parameters, const StateVector& e, const Vector3& push_b)
      : p(parameters), filter(begun_with(parameters, e, truth.state())) {
    for (int k = 0; k < kSteps; ++k) {
      const ImuSample sample = truth.next(push_b);
      ImuInterval interval;
      interval.end_ns = truth.time_ns();
      interval.increments = {sample.dtheta_b, sample.dv_b, kDt_s};
      filter.advance(interval);
    }
  }

  std::vector<Measurement> made() const { return measurements_of(travel(1.0, truth.time_ns()), filter.situation(), p); }
  Eigen::Vector3d innovations() const {
    const std::vector<Measurement> both = made();
    Eigen::Vector3d all;
    all << both.at(0).innovation, both.at(1).innovation;
    return all;
  }

 private:
  static InertialFilter begun_with(const NavigationParameters& p, const StateVector& e, nav::NavState start) {
    const StateLayout layout(p.states);
    start.position = nav::displaced(start.position, Vector3(e.segment<3>(kPosition)));
    start.v_n += e.segment<3>(kVelocity);
    start.q_nb = nav::quaternion_from_rotation_vector(-e.segment<3>(kAttitude)) * start.q_nb;
    Estimates errors;
    layout.for_each_chosen(
        [&](StateBlock block) { errors[block].head(size_of(block)) = e.segment(layout.first(block), size_of(block)); });
    return {p, kGravity, start, errors, Covariance(initial_sigmas(p)), 0, std::nullopt};
  }
};

// H says what errors at the interval's end, where the filter is, show in the mean of the interval; errors at its
// beginning, which central differences change here, come there by the filter's own transition. What both leave out is
// of second order in the interval, 0.1 s: of a turn of 0.01 rad and of 10 m/s, 0.001 m/s for 1 rad.
TEST(WheelMotion, TheirDerivativesAreThoseOfWhatTheyPredict) {
  NavigationParameters p = told_of_a_wheel();
  p.odometer.lever_arm_b_m = Vector3(-1.0, 0.8, 0.5);
  p.odometer.mounting_rpy_deg = Vector3(3.0, -4.0, 15.0);
  p.covariance_interval_s = 1.0;  // one step for all of it
  const StateLayout layout(p.states);
  StateVector e = StateVector::Zero(layout.size());
  e.segment<2>(layout.first(StateBlock::WheelScale)) << 0.01, 0.002;
  e.segment<2>(layout.first(StateBlock::WheelAxis)) << 0.02, -0.03;
  const Vector3 push_b(2.0, 0.0, 0.0);
  const AtTheEnd there(p, e, push_b);
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Identity(layout.size(), layout.size());
  Phi.topLeftCorner<9, 9>() = there.filter.transition().nav_by_nav;
  Eigen::MatrixXd H(3, layout.size());
  Eigen::Index row = 0;
  for (const Measurement& m : there.made()) {
    H.middleRows(row, m.rows()) = m.H(layout);
    row += m.rows();
  }
  ASSERT_EQ(row, 3);
  const Eigen::MatrixXd by_start = H * Phi;
  for (Eigen::Index i = kVelocity; i < layout.size(); ++i) {
    const bool is_of_the_imu = i >= kNavStates && i < layout.first(StateBlock::WheelScale);
    if (is_of_the_imu) continue;
    const double h = i < kAttitude ? 0.01 : 1e-5;
    StateVector up = e, down = e;
    up[i] += h;
    down[i] -= h;
    const Eigen::VectorXd slope =
        (AtTheEnd(p, up, push_b).innovations() - AtTheEnd(p, down, push_b).innovations()) / (2.0 * h);
    EXPECT_LT((slope - by_start.col(i)).norm(), 0.005) << "state " << i;
  }
}

// A gyro that errs turns the wheel about the IMU: central differences of what is linear.
TEST(WheelMotion, TheirLeverArmCarriesTheErrorsOfTheGyros) {
  NavigationParameters p = told_of_a_wheel();
  p.odometer.lever_arm_b_m = Vector3(-1.0, 0.8, 0.5);
  p.odometer.mounting_rpy_deg = Vector3(3.0, -4.0, 15.0);
  const StateLayout layout(p.states);
  Situation at;
  at.v_n = Vector3(10.0, 1.0, 0.0);
  at.omega_ib_b = Vector3(0.1, -0.2, 0.5);
  at.estimates[StateBlock::GyroScale] = Vector3(0.01, -0.02, 0.03);
  at.rate_by_measured = (Vector3::Ones() + at.estimates[StateBlock::GyroScale]).cwiseInverse();
  const auto innovation = [&](const Vector3& bias, const Vector3& scale) {
    const Vector3 measured = at.omega_ib_b.cwiseQuotient(at.rate_by_measured);
    const Vector3 corrected =
        (measured - bias).cwiseQuotient(Vector3::Ones() + at.estimates[StateBlock::GyroScale] + scale);
    RecentMotion recent(0);
    recent.add(kInterval_ns, at.v_n, at.v_n, kInterval_s * corrected);
    at.recent = &recent;
    Eigen::Vector3d all;
    const auto made = measurements_of(travel(1.0, kInterval_ns), at, p);
    all << made[0].innovation, made[1].innovation;
    Eigen::MatrixXd H(3, layout.size());
    H << made[0].H(layout), made[1].H(layout);
    at.recent = nullptr;
    return std::pair(all, H);
  };
  const double h = 1e-4;
  const Eigen::MatrixXd H = innovation(Vector3::Zero(), Vector3::Zero()).second;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Vector3 step = h * Vector3::Unit(axis), zero = Vector3::Zero();
    const Eigen::Vector3d by_bias = (innovation(step, zero).first - innovation(-step, zero).first) / (2.0 * h);
    const Eigen::Vector3d by_scale = (innovation(zero, step).first - innovation(zero, -step).first) / (2.0 * h);
    EXPECT_LT((by_bias - H.col(layout.first(StateBlock::GyroBias) + axis)).norm(), 1e-8);
    EXPECT_LT((by_scale - H.col(layout.first(StateBlock::GyroScale) + axis)).norm(), 1e-6);
  }
}

// A car that brakes by 4 m/s^2 in a turn of 0.5 rad/s, its wheel 0.8 m inside: the mean of the interval differs from
// its end by 0.2 m/s, from its middle by 1e-3 m/s at most, and the prediction from it by less than 1e-5.
TEST(WheelMotion, PredictTheMeanOfTheIntervalAndNotItsEnd) {
  NavigationParameters p = told_of_a_wheel();
  p.odometer.lever_arm_b_m = Vector3(-1.0, 0.8, 0.5);
  Circling truth(15.0, 0.5);
  NavigationFilter filter = begun(truth, p);
  Wheel wheel(p.odometer.lever_arm_b_m);
  const Vector3 push_b(-4.0, 0.0, 0.0);
  filter.add(truth.next(push_b));
  wheel.begin(truth);
  for (int k = 0; k < kSteps; ++k) {
    filter.add(truth.next(push_b));
    wheel.advance(truth);
  }
  const Vector3 mean_b = wheel.take() / kInterval_s;
  const auto made = measurements_of(travel(mean_b.x() * kInterval_s, truth.time_ns()), filter.filter()->situation(), p);
  ASSERT_EQ(made.size(), 2U);
  EXPECT_NEAR(made[0].innovation[0], 0.0, 1e-5);
  EXPECT_NEAR(made[1].innovation[0], mean_b.y(), 1e-5);
  EXPECT_NEAR(made[1].innovation[1], mean_b.z(), 1e-5);
}

// What is asked for may begin between two samples, or reach back further than is kept.
TEST(WheelMotion, RecentMotionKnowsEveryIntervalOfTheLastSecond) {
  RecentMotion motion(0);
  for (std::int64_t k = 0; k < 1000; ++k) {
    const double t_s = kDt_s * static_cast<double>(k);
    const Vector3 begin(3.0 * t_s, 0.0, 1.0), end(3.0 * (t_s + kDt_s), 0.0, 1.0);
    motion.add((k + 1) * kDt_ns, begin, end, kDt_s * Vector3(0.0, 0.0, 0.2));
  }
  const auto means = motion.over(432'100'000);
  ASSERT_TRUE(means);
  EXPECT_NEAR(means->v_b_less_now.x(), -0.5 * 3.0 * 0.4321, 3.0 * kDt_s * kDt_s / 0.4321);
  EXPECT_NEAR(means->omega_eb_b.z(), 0.2, 1e-12);
  EXPECT_TRUE(motion.over(1'000'000'000));
  EXPECT_FALSE(motion.over(2'100'000'000));
  EXPECT_FALSE(motion.over(0));
}

}  // namespace wheel_motion_test
}  // namespace inslab::navigation
