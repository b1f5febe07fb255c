#include "inslab/models/navigation/navigator.hpp"

#include <gtest/gtest.h>

namespace inslab::navigation {
namespace navigator_test {

constexpr std::int64_t kDt_ns = 5'000'000;
const nav::Gravity kGravity;
const nav::NavState kStart{{0.53, 2.0, 50.0}, Vector3::Zero(), nav::Quaternion::Identity()};

ImuSample imu_sample(std::uint64_t k, std::int64_t latency_ns = 0) {
  ImuSample sample;
  sample.header.sequence_number = k;
  sample.header.sim_time_ns = static_cast<std::int64_t>(k + 1) * kDt_ns;
  sample.available_sim_time_ns = sample.header.sim_time_ns + latency_ns;
  sample.interval_ns = kDt_ns;
  sample.dv_b = Vector3(0.0, 0.0, -9.79 * 0.005);
  return sample;
}

GnssFix fix_at(std::int64_t time_ns, std::int64_t latency_ns = 0) {
  GnssFix fix;
  fix.header.sim_time_ns = time_ns;
  fix.available_sim_time_ns = time_ns + latency_ns;
  fix.fix_type = FixType::Fixed;
  fix.latitude_rad = kStart.position.latitude_rad;
  fix.longitude_rad = kStart.position.longitude_rad;
  fix.height_m = kStart.position.height_m;
  fix.position_sigma_ned_m = Vector3::Constant(0.02);
  return fix;
}

Navigator begun() {
  Navigator navigator(NavigationParameters{}, kGravity);
  navigator.start(kStart, 0);
  return navigator;
}

/// Steps until no sample's turn has come; the fixes that were taken in meanwhile.
std::size_t fixes_taken_in(Navigator& navigator) {
  while (navigator.step()) continue;
  return navigator.filter().take_results().size();
}

TEST(Navigator, AnswersEachSampleAtOnceWhenNobodySaysWhichFixesAreComplete) {
  Navigator navigator = begun();
  navigator.add(imu_sample(0));
  const auto step = navigator.step();
  ASSERT_TRUE(step);
  EXPECT_EQ(step->imu_sequence, 0u);
  EXPECT_TRUE(step->solution);
  EXPECT_FALSE(navigator.step());
}

TEST(Navigator, HoldsASampleBackUntilTheFixesBeforeItAreComplete) {
  Navigator navigator = begun();
  navigator.fixes_complete_up_to(kDt_ns - 1);
  navigator.add(imu_sample(0));
  EXPECT_FALSE(navigator.step());
  navigator.fixes_complete_up_to(kDt_ns);
  EXPECT_TRUE(navigator.step());
}

TEST(Navigator, ASampleWithLatencyWaitsForTheFixesThatAreAvailableBeforeIt) {
  Navigator navigator = begun();
  navigator.fixes_complete_up_to(kDt_ns);
  navigator.add(imu_sample(0, 2 * kDt_ns));
  EXPECT_FALSE(navigator.step());
  navigator.fixes_complete_up_to(3 * kDt_ns);
  EXPECT_TRUE(navigator.step());
}

TEST(Navigator, AFixIsTakenInWithTheFirstSampleThatIsAvailableNoEarlier) {
  Navigator navigator = begun();
  navigator.add(fix_at(kDt_ns, 2 * kDt_ns));
  navigator.add(imu_sample(0));
  navigator.add(imu_sample(1));
  EXPECT_EQ(fixes_taken_in(navigator), 0u);
  navigator.add(imu_sample(2));
  EXPECT_EQ(fixes_taken_in(navigator), 1u);
}

TEST(Navigator, GivesTheSameSolutionsInWhateverOrderTheInputsAreHandedOver) {
  Navigator fixes_first = begun(), samples_first = begun();
  samples_first.fixes_complete_up_to(-1);
  for (std::uint64_t k = 0; k < 100; ++k) samples_first.add(imu_sample(k));
  for (std::int64_t k = 5; k < 100; k += 20) {
    fixes_first.add(fix_at(k * kDt_ns, 3 * kDt_ns));
    samples_first.add(fix_at(k * kDt_ns, 3 * kDt_ns));
  }
  samples_first.fixes_complete_up_to(Navigator::kEver);
  for (std::uint64_t k = 0; k < 100; ++k) {
    fixes_first.add(imu_sample(k));
    const auto a = fixes_first.step(), b = samples_first.step();
    ASSERT_TRUE(a && b && a->solution && b->solution);
    EXPECT_EQ(a->imu_sequence, b->imu_sequence);
    ASSERT_EQ(a->solution->height_m, b->solution->height_m) << k;
    ASSERT_EQ(a->solution->position_sigma_ned_m, b->solution->position_sigma_ned_m) << k;
  }
  EXPECT_EQ(fixes_first.filter().take_results().size(), 5u);
}

TEST(Navigator, TakesThoseOfOneTimeAndKindInTheOrderOfTheirSensorsWhicheverCameFirst) {
  GnssFix first = fix_at(kDt_ns), second = fix_at(kDt_ns);
  second.sensor_number = 1;
  second.latitude_rad += 1e-8;
  const auto latitude_after = [](const GnssFix& one, const GnssFix& other) {
    Navigator navigator = begun();
    navigator.add(one);
    navigator.add(other);
    navigator.add(imu_sample(0));
    navigator.add(imu_sample(1));
    EXPECT_EQ(fixes_taken_in(navigator), 2u);
    navigator.add(imu_sample(2));
    return navigator.step()->solution->latitude_rad;
  };
  EXPECT_EQ(latitude_after(first, second), latitude_after(second, first));
}

}  // namespace navigator_test
}  // namespace inslab::navigation
