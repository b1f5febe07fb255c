#include "inslab/scenario/load.hpp"

#include <gtest/gtest.h>

namespace inslab::scenario {
namespace load_test {

LoadedScenario demo() { return load(std::string(INSLAB_SOURCE_DIR) + "/config/scenarios/demo.json"); }

TEST(LoadedScenario, HasItsProfilesReadAndAddressed) {
  const LoadedScenario loaded = demo();
  ASSERT_EQ(loaded.imus.size(), 1U);
  ASSERT_EQ(loaded.gnss.size(), 1U);
  EXPECT_EQ(loaded.imus[0].errors.name, "stim300");
  EXPECT_EQ(loaded.imus[0].errors.target, (SensorAddress{SensorKind::Imu, 0}));
  EXPECT_EQ(loaded.gnss[0].errors.name, "rtk");
  EXPECT_EQ(loaded.gnss[0].installation.target, (SensorAddress{SensorKind::Gnss, 0}));
}

TEST(LoadedScenario, TellsTheAppTheTrueInstallationUnlessAnotherIsNamed) {
  const LoadedScenario loaded = demo();
  EXPECT_EQ(loaded.imus[0].nominal_installation.lever_arm_v_m, loaded.imus[0].installation.lever_arm_v_m);
  EXPECT_EQ(loaded.gnss[0].nominal_installation.lever_arm_v_m, loaded.gnss[0].installation.lever_arm_v_m);
}

TEST(LoadedScenario, CountsSampleZeroAndTheLast) {
  // 60 s at 200 Hz.
  EXPECT_EQ(demo().truth_samples, 12001U);
}

TEST(LoadedScenario, MakesRequestsOfItsSchedule) {
  const LoadedScenario loaded = demo();
  ASSERT_EQ(loaded.swaps.size(), loaded.scenario.swaps.size());
  for (std::size_t i = 0; i < loaded.swaps.size(); ++i) {
    const ScheduledSwap& planned = loaded.scenario.swaps[i];
    const ProfileRequest& request = catalog::request_of(loaded.swaps[i]);
    EXPECT_EQ(request.request_id, i + 1);
    EXPECT_EQ(request.apply_at_ns, time::from_seconds(planned.at_s).count());
    EXPECT_EQ(request.fade_s, planned.fade_s);
    EXPECT_EQ(request.continuity, planned.continuity);
    EXPECT_EQ(catalog::kind_of(loaded.swaps[i]), planned.kind);
    EXPECT_EQ(catalog::target_of(loaded.swaps[i]), (SensorAddress{planned.sensor_kind, planned.sensor_number}));
  }
}

TEST(LoadedScenario, StartsWhenItSaysOrNow) {
  LoadedScenario loaded = demo();
  const time::Nanoseconds now = std::chrono::hours(24 * 365 * 56);
  EXPECT_EQ(loaded.start(now), (time::GpsTime{2446, 36'000'000'000'000}));
  loaded.scenario.start.at = StartAt::Now;
  EXPECT_EQ(loaded.start(now), time::gps_from_realtime(now));
}

TEST(LoadedScenario, HasTheGravityOfItsOptions) {
  LoadedScenario loaded = demo();
  const nav::Geodetic place = loaded.start_position();
  const Vector3 normal = loaded.gravity().g_n(place);
  loaded.scenario.trajectory.gravity.disturbance_mgal = 100.0;
  EXPECT_NEAR(loaded.gravity().g_n(place).z() - normal.z(), 100e-5, 1e-9);
  EXPECT_EQ(loaded.gravity_model().g_n(place), normal) << "an app knows nothing of the disturbance";

  loaded.scenario.trajectory.gravity.variation = GravityVariation{};
  const Vector3 varied = loaded.gravity().g_n(place);
  EXPECT_GT((varied - normal).norm(), 1e-6);
  EXPECT_EQ(loaded.gravity().g_n(place), varied) << "of the seed and the place alone";
  EXPECT_EQ(loaded.gravity_model().g_n(place), normal);
  loaded.scenario.seed += 1;
  EXPECT_NE(loaded.gravity().g_n(place), varied);
}

}  // namespace load_test
}  // namespace inslab::scenario
