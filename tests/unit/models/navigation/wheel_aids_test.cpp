#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include "inslab/models/navigation/matching_odometer.hpp"
#include "inslab/models/navigation/rolling_without_slide.hpp"
#include "inslab/models/navigation/wheel_speed.hpp"
#include "tests/unit/models/navigation/drawn_run.hpp"
#include "tests/unit/models/navigation/rolling_wheel.hpp"

namespace inslab::navigation {
namespace wheel_aids_test {

using namespace circling;

/// Follows a circle with fixes for `fixes_s`, with a wheel's samples all the time.
struct Driven {
  Circling truth;
  NavigationFilter filter;
  Wheel wheel;

  explicit Driven(const NavigationParameters& p) : filter(begun(truth, p)), wheel(p.odometer.lever_arm_b_m) {
    wheel.begin(truth);
  }
  /// The wheel's samples become what `seen` makes of them; none when it gives none.
  template <class Seen>
  void drive(int steps, int fixed_steps, const Seen& seen) {
    for (int k = 0; k < steps; ++k) {
      filter.add(truth.next());
      wheel.advance(truth);
      if (k < fixed_steps && is_fix_time(truth)) filter.add(truth.fix());
      if (k % kSteps != kSteps - 1) continue;
      const std::optional<WheelTravel> sample = seen(travel(wheel.take().x(), truth.time_ns()), k);
      if (sample) filter.add(*sample);
    }
  }
};

TEST(WheelAids, FindAScaleFactorAndAnAxisThatNobodyToldOf) {
  NavigationParameters p = told_of_a_wheel();
  // The wheel points 1 deg to the left and 0.5 deg up of what is true of the circle's.
  p.odometer.mounting_rpy_deg = Vector3(0.0, 0.5, -1.0);
  p.odometer.axis_sigma_deg = 1.0;
  p.rolling_constraint.lasts_s = 0.0;
  Driven car(p);
  car.drive(16000, 16000, [](WheelTravel sample, int) {
    sample.distance_m *= 1.01;
    return std::optional(sample);
  });
  const Estimates& found = car.filter.filter()->estimates();
  EXPECT_NEAR(found[StateBlock::WheelScale].sum(), 0.01, 0.0005);
  EXPECT_NEAR(found[StateBlock::WheelAxis][0] / units::kDeg, -0.5, 0.05);
  EXPECT_NEAR(found[StateBlock::WheelAxis][1] / units::kDeg, 1.0, 0.05);
}

// A wheel that locks, and one that spins at twice its speed.
TEST(WheelAids, WhatTheInnovationTestRefusesChangesNothing) {
  NavigationParameters p = told_of_a_wheel();
  p.rolling_constraint.use = false;
  Driven slips(p), hears_nothing(p);
  slips.drive(4000, 4000, [](WheelTravel sample, int k) {
    if (k > 2000 && k < 2400) sample.distance_m *= k < 2200 ? 0.0 : 2.0;
    return std::optional(sample);
  });
  hears_nothing.drive(4000, 4000, [](const WheelTravel& sample, int k) {
    return k > 2000 && k < 2400 ? std::nullopt : std::optional(sample);
  });
  std::size_t refused = 0;
  for (const UpdateResult& result : slips.filter.take_results()) {
    EXPECT_EQ(result.of("rolling_without_slide"), nullptr);
    const MeasurementResult* speed = result.of("wheel_speed");
    refused += speed != nullptr && !speed->accepted ? 1 : 0;
  }
  EXPECT_EQ(refused, 20U);
  const nav::NavState a = slips.filter.filter()->state(), b = hears_nothing.filter.filter()->state();
  EXPECT_LT(nav::ned_from(a.position, b.position).norm(), 1e-6);
}

// Slower than 0.75 m/s it counts nothing, and says nothing of the speed; that it does not slide it still says.
TEST(WheelAids, CountsOfAWheelThatIsTooSlowAreNoStandstill) {
  NavigationParameters p = told_of_a_wheel();
  p.odometer.dead_below_m_per_s = 0.75;
  p.odometer.count_m = 0.02;
  Circling truth(0.6, 0.0);
  NavigationFilter filter = begun(truth, p);
  for (int k = 0; k < kSteps; ++k) filter.add(truth.next());
  const auto names = [&](double distance_m) {
    std::vector<std::string_view> all;
    for (const Measurement& m : measurements_of(travel(distance_m, truth.time_ns()), filter.filter()->situation(), p)) {
      all.push_back(m.name);
    }
    return all;
  };
  EXPECT_EQ(names(0.0), std::vector<std::string_view>{"rolling_without_slide"});
  EXPECT_EQ(names(0.06).size(), 1U) << "a count may be of before";
  p.odometer.dead_below_m_per_s = 0.3;
  EXPECT_EQ(names(0.06).size(), 2U);
  EXPECT_EQ(names(0.0).size(), 1U) << "it shows less than one that is heard at all";
}

// Backwards at 3 m/s an odometer that does not know the direction shows 3 m/s.
TEST(WheelAids, WithoutADirectionTheSpeedIsItsSize) {
  const NavigationParameters p = told_of_a_wheel();
  for (const double speed_m_per_s : {-3.0, 3.0, 0.2}) {
    Circling truth(speed_m_per_s, 0.0);
    NavigationFilter filter = begun(truth, p);
    for (int k = 0; k < kSteps; ++k) filter.add(truth.next());
    WheelTravel sample = travel(3.0 * kInterval_s, truth.time_ns());
    sample.direction_known = false;
    const auto made = measurements_of(sample, filter.filter()->situation(), p);
    if (speed_m_per_s == 0.2) {
      EXPECT_EQ(made.size(), 1U) << "which way it rolls is not sure";
      continue;
    }
    EXPECT_NEAR(made[0].innovation[0], 0.0, 1e-6);
    EXPECT_NEAR(made[0].row(0, StateLayout(p.states))[kVelocity], speed_m_per_s < 0.0 ? -1.0 : 1.0, 1e-3);
  }
}

// Left and right of a car that circles at 0.1 rad/s and 10 m/s, 0.8 m to either side: 10.08 and 9.92 m/s.
TEST(WheelAids, TheOtherOdometerIsHeldAgainstItsOwnWheel) {
  NavigationParameters p = told_of_a_wheel();
  p.other_odometer = p.odometer;
  p.other_odometer.number = 7;
  p.odometer.lever_arm_b_m = Vector3(0.0, -0.8, 0.0);
  p.other_odometer.lever_arm_b_m = Vector3(0.0, 0.8, 0.0);
  Circling truth;
  NavigationFilter filter = begun(truth, p);
  for (int k = 0; k < kSteps; ++k) filter.add(truth.next());
  const Situation at = filter.filter()->situation();
  const auto left = measurements_of(travel(1.008, truth.time_ns(), 0), at, p);
  const auto right = measurements_of(travel(0.992, truth.time_ns(), 7), at, p);
  ASSERT_EQ(left.size(), 2U);
  ASSERT_EQ(right.size(), 1U) << "one wheel says that the axle does not slide";
  EXPECT_NEAR(left[0].innovation[0], 0.0, 1e-4);
  EXPECT_NEAR(right[0].innovation[0], 0.0, 1e-4);
  EXPECT_TRUE(measurements_of(travel(1.0, truth.time_ns(), 3), at, p).empty());
}

// A slide of 0.1 m/s that lasts 0.5 s is one slide in five samples of 0.1 s.
TEST(WheelAids, ASlideThatLastsCountsOnce) {
  NavigationParameters p = told_of_a_wheel();
  p.rolling_constraint.lateral_sigma_m_per_s = 0.1;
  Circling truth;
  NavigationFilter filter = begun(truth, p);
  for (int k = 0; k < kSteps; ++k) filter.add(truth.next());
  for (const double lasts_s : {0.0, 0.1, 0.5}) {
    p.rolling_constraint.lasts_s = lasts_s;
    const auto made = measurements_of(travel(1.0, truth.time_ns()), filter.filter()->situation(), p);
    EXPECT_NEAR(made[1].R[0], lasts_s == 0.5 ? 0.05 : 0.01, 1e-12);
    EXPECT_NEAR(made[1].R[1], lasts_s == 0.5 ? 0.0125 : 0.0025, 1e-12);
  }
}

TEST(WheelAids, SamplesThatComeLateGiveTheSameBitsAsInTime) {
  const NavigationParameters p = told_of_a_wheel();
  Circling truth;
  NavigationFilter in_time = begun(truth, p), late = in_time;
  std::multimap<std::int64_t, WheelTravel> on_their_way;
  std::int64_t count = 0;
  for (int k = 0; k < 2400; ++k) {
    const ImuSample sample = truth.next();
    in_time.add(sample);
    late.add(sample);
    if (is_fix_time(truth)) {
      in_time.add(truth.fix());
      late.add(truth.fix());
    }
    if (k % kSteps == 7 && k < 2200) {
      const WheelTravel rolled = travel(1.0 + 0.003 * std::sin(k), truth.time_ns());
      in_time.add(rolled);
      on_their_way.emplace(truth.time_ns() + 110'000'000 + 150'000'000 * (3 * count++ % 5), rolled);
    }
    while (!on_their_way.empty() && on_their_way.begin()->first <= truth.time_ns()) {
      late.add(on_their_way.begin()->second);
      on_their_way.erase(on_their_way.begin());
    }
  }
  EXPECT_EQ(in_time.filter()->covariance().matrix(), late.filter()->covariance().matrix());
  EXPECT_EQ(in_time.filter()->state().v_n, late.filter()->state().v_n);
  EXPECT_EQ(in_time.filter()->estimates()[StateBlock::WheelAxis], late.filter()->estimates()[StateBlock::WheelAxis]);
  EXPECT_EQ(late.counts().fixes_too_old, 0U);
  std::size_t taken = 0;
  for (const UpdateResult& result : late.take_results()) taken += result.of("wheel_speed") != nullptr ? 1 : 0;
  EXPECT_EQ(taken, 109U) << "all but the first, whose interval begins before the filter";
}

TEST(WheelAids, TheirParametersMatchAProfileAndChooseWhatThereIsToEstimate) {
  OdometerErrorProfile errors;
  errors.target = {SensorKind::Odometer, 4};
  InstallationProfile place, imu_place;
  place.lever_arm_v_m = Vector3(0.0, -0.8, 0.3);
  place.mounting_rpy_deg = Vector3(0.0, 0.0, 2.0);
  imu_place.lever_arm_v_m = Vector3(0.0, 0.2, 0.0);
  imu_place.mounting_rpy_deg = Vector3(0.0, 0.0, 90.0);
  NavigationParameters p;
  match(errors, place, imu_place, p);
  EXPECT_FALSE(p.states.wheel_axis) << "nobody takes it";
  p.odometer.number = 4;
  match(errors, place, imu_place, p);
  EXPECT_LT((p.odometer.lever_arm_b_m - Vector3(-1.0, 0.0, 0.3)).norm(), 1e-12);
  EXPECT_LT((p.odometer.mounting_rpy_deg - Vector3(0.0, 0.0, 272.0)).norm(), 1e-12);
  EXPECT_TRUE(p.states.wheel_axis);
  EXPECT_FALSE(p.states.wheel_scale || p.states.other_wheel_scale);
  errors.scale_factor_ppm = -3000.0;
  errors.scale_factor_turn_on_sigma_ppm = 4000.0;
  errors.scale_factor_gm_sigma_ppm = 300.0;
  errors.scale_factor_gm_correlation_time_s = 1800.0;
  errors.tyre_warming_ppm = -400.0;
  errors.noise_m_per_sqrt_m = 0.002;
  errors.counts_per_revolution = 100.0;
  errors.wheel_circumference_m = 1.9;
  errors.dead_below_m_per_s = 0.7;
  p.other_odometer.number = 4;
  p.odometer.number = 1;
  match(errors, place, imu_place, p);
  EXPECT_TRUE(p.states.other_wheel_scale && !p.states.wheel_scale);
  EXPECT_NEAR(p.other_odometer.scale_factor_sigma_ppm, 5000.0, 1e-9);
  EXPECT_NEAR(p.other_odometer.scale_factor_drift_sigma_ppm, 500.0, 1e-9);
  EXPECT_EQ(p.other_odometer.scale_factor_drift_correlation_time_s, 1800.0);
  EXPECT_EQ(p.other_odometer.noise_m_per_sqrt_m, 0.002);
  EXPECT_NEAR(p.other_odometer.count_m, 0.019, 1e-15);
  EXPECT_EQ(p.other_odometer.dead_below_m_per_s, 0.7);
}

/// The vehicle slides: at the beginning of each interval of the odometer its velocity across and away from the road
/// becomes another one, drawn.
double nees_of_run(std::uint64_t seed) {
  NavigationParameters told_of = told_of_a_wheel();
  told_of.rolling_constraint.lasts_s = 0.0;
  told_of.odometer.scale_factor_drift_correlation_time_s = 0.0;
  told_of.odometer.noise_m_per_sqrt_m = 0.02;
  told_of.odometer.lever_arm_b_m = Vector3(-1.0, 0.8, 0.5);
  DrawnRun run(told_of, seed, "wheel_aids_test");
  const NavigationParameters& p = run.parameters();
  const double scale = -run.of(StateBlock::WheelScale).sum();
  const Vector3 axis = -run.of(StateBlock::WheelAxis);
  Wheel wheel(p.odometer.lever_arm_b_m);
  wheel.begin(run.truth());
  Vector3 slide = Vector3::Zero();
  for (int k = 0; k < 8000; ++k) {
    const double t_s = kDt_s * k;
    Vector3 push_b(1.5 * std::cos(0.4 * t_s), 0.0, 0.0);
    if (k % kSteps == 0) {
      const double lateral = p.rolling_constraint.lateral_sigma_m_per_s * run.normal();
      const double vertical = p.rolling_constraint.vertical_sigma_m_per_s * run.normal();
      const Vector3 v_b = run.truth().velocity_b(p.odometer.lever_arm_b_m);
      // Of the wheel's true axes, which lie beside those that the filter is told of, its velocity is this.
      slide = Vector3(0.0, lateral + axis[1] * v_b.x(), vertical - axis[0] * v_b.x()) - Vector3(0.0, v_b.y(), v_b.z());
      push_b += slide / kDt_s;
    }
    run.advance(push_b);
    wheel.advance(run.truth());
    if (k < 4000) run.fix_if_due();
    if (k % kSteps != kSteps - 1) continue;
    const Vector3 way_m = wheel.take();
    const double along_m = way_m.x() - axis[0] * way_m.z() + axis[1] * way_m.y();
    const double noise_m = std::hypot(p.odometer.sigma_m_per_s * kInterval_s,
                                      p.odometer.noise_m_per_sqrt_m * std::sqrt(std::abs(along_m)));
    run.filter().add(travel((1.0 + scale) * along_m + noise_m * run.normal(), run.truth().time_ns()));
  }
  return run.nees();
}

// 40 s, of which the last 20 without fixes.
TEST(WheelAids, AreHonestWithScaleAndAxisOver100Runs) { expect_honest_over_100_runs(25, nees_of_run); }

}  // namespace wheel_aids_test
}  // namespace inslab::navigation
