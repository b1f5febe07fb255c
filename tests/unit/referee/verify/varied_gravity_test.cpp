#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/nav_state.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/referee/verify/loop.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::verify {
namespace varied_gravity_test {

using scenario::LoadedScenario;

/// A scenario of config/ with gravity of the mountains, at 200 Hz.
LoadedScenario in_the_mountains(const std::string& name) {
  LoadedScenario loaded = scenario::load(INSLAB_SOURCE_DIR "/config/scenarios/" + name);
  loaded.scenario.trajectory.gravity.variation = scenario::GravityVariation{scenario::GravityTerrain::Mountains};
  return loaded;
}

double off_m(const LoadedScenario& loaded, const nav::Gravity& known, std::uint64_t steps) {
  const auto truth = trajectory::make_truth_model(loaded, {2300, 0});
  const auto expected = [](const TruthState& now) { return nav_state(now); };
  return close_loop(*truth, product_imu, known, {{product_mechanization, {}}}, time::Rate(200.0), steps, expected)
      .front()
      .position_max_m;
}

class VariedGravity : public testing::TestWithParam<const char*> {};

/// A perfect IMU's mechanization that knows the field comes back to the truth; one that knows the model alone does not.
TEST_P(VariedGravity, IsInTheIncrementsExactly) {
  const LoadedScenario loaded = in_the_mountains(GetParam());
  LoadedScenario plain = loaded;
  plain.scenario.trajectory.gravity.variation.reset();
  const std::uint64_t steps = 60 * 200;
  EXPECT_NEAR(off_m(loaded, loaded.gravity(), steps), off_m(plain, plain.gravity(), steps), 1e-5)
      << "what the two-sample mechanization leaves, field or not";
  const double unknown_m = off_m(loaded, loaded.gravity_model(), steps);
  EXPECT_GT(unknown_m, 0.02);
  // A disturbance of 15 arcsec and 20 mGal held for a minute makes half its square of the time.
  EXPECT_LT(unknown_m, 3.0 * 0.5 * 60.0 * 60.0 * 15.0 / 206265.0 * 9.8);
}

INSTANTIATE_TEST_SUITE_P(Sources, VariedGravity,
                         testing::Values("demo.json", "car_tunnel.json", "delivery_drone.json", "aircraft.json"),
                         [](const testing::TestParamInfo<const char*>& of) {
                           return std::filesystem::path(of.param).stem().string();
                         });

}  // namespace varied_gravity_test
}  // namespace inslab::verify
