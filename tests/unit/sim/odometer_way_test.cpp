// An odometer's way is the integral of the speed of its contact, however coarse the truth.

#include <gtest/gtest.h>

#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/odometer/wheel_contact.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::sim {
namespace odometer_way_test {

struct Way {
  double by_the_odometer_m = 0.0;
  double by_velocities_m = 0.0;  ///< trapezoids of the speed of the contact along the wheel
};

Way way_at(double truth_rate_hz) {
  scenario::LoadedScenario scenario = scenario::load(INSLAB_SOURCE_DIR "/config/scenarios/aiding.json");
  scenario.truth_rate = time::Rate(truth_rate_hz);
  const InstallationProfile installation = scenario.odometers[0].installation;
  // The truth has a sample at every instant of a sensor: without them at its own rate alone.
  for_each(catalog::SensorKinds{}, [&scenario](auto kind) {
    using Kind = typename decltype(kind)::type;
    (scenario.scenario.*scenario::Section<Kind>::sensors).clear();
    (scenario.*scenario::LoadedSection<Kind>::sensors).clear();
  });
  scenario.truth_samples = 1 + scenario.truth_grid().index(time::from_seconds(scenario.scenario.duration_s));
  odometer::WheelContact contact;
  contact.use(installation);
  const double yaw = installation.mounting_rpy_deg.z() * units::kDeg;
  const auto speed = [&](const TruthState& truth) {
    const SensorSite site = sensor_site(truth, installation.lever_arm_v_m);
    const Vector3 v_v = truth.q_nv.conjugate() * (site.C_sn.transpose() * site.v_n);
    return v_v.x() * std::cos(yaw) + v_v.y() * std::sin(yaw);
  };
  TruthSource source(scenario, scenario.start(time::Nanoseconds(0)), RunId());
  Way way;
  std::optional<TruthState> last;
  while (source.has_next()) {
    const TruthState truth = source.take();
    if (last) {
      way.by_the_odometer_m += contact.over(*last, truth).along_m;
      way.by_velocities_m += 0.5 * (speed(*last) + speed(truth)) * time::to_seconds(truth.interval_ns);
    }
    last = truth;
  }
  return way;
}

TEST(OdometerWay, IsTheIntegralOfTheSpeedOfItsContact) {
  // Through straights, turns and a change of speed. Trapezoids at 1 kHz are off by dt^2/12 of the change of the
  // acceleration: 8e-8 s^2 times 5 m/s^2 and less.
  const Way fine = way_at(1000.0), coarse = way_at(50.0);
  EXPECT_GT(fine.by_velocities_m, 300.0);
  EXPECT_NEAR(fine.by_the_odometer_m, fine.by_velocities_m, 5e-6);
  EXPECT_NEAR(coarse.by_the_odometer_m, fine.by_the_odometer_m, 1e-5);
}

}  // namespace odometer_way_test
}  // namespace inslab::sim
