#include "inslab/models/navigation/tag_time.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "inslab/models/navigation/navigator.hpp"
#include "inslab/noise/random/stream.hpp"
#include "tests/unit/models/navigation/circling.hpp"

/// The filter navigates by the tags of its sensors.
namespace inslab::navigation {
namespace tag_time_test {

using circling::Circling;
using circling::kDt_ns;
using circling::kGravity;

const time::GpsTime kStart{2400, 345600000000000};

/// Tagged `error_ns` too late.
template <class Sample>
Sample tagged(Sample sample, std::int64_t error_ns) {
  const time::GpsTime tag = kStart + time::Nanoseconds(sample.header.sim_time_ns + error_ns);
  sample.header.gps_week = tag.week;
  sample.header.gps_time_of_week_ns = tag.time_of_week_ns;
  return sample;
}

struct Circuit {
  NavSolution last;
  nav::NavState truth;
  std::uint64_t refused = 0;
};

/// 60 s of the circle with a fix every 200 ms, `imu` and `gnss` the errors of sample k's tag.
template <class Imu, class Gnss>
Circuit circuit(const Imu& imu, const Gnss& gnss, bool tags = true) {
  Circling vehicle;
  Navigator navigator(NavigationParameters{}, kGravity);
  navigator.start(vehicle.state(), 0);
  Circuit circuit;
  for (std::uint64_t k = 0; k < 12000; ++k) {
    ImuSample sample = vehicle.next();
    sample.available_sim_time_ns = sample.header.sim_time_ns;
    navigator.add(tags ? tagged(sample, imu(k)) : sample);
    if (k % 40 == 39) {
      GnssFix fix = vehicle.fix();
      fix.available_sim_time_ns = fix.header.sim_time_ns;
      navigator.add(Observation(tags ? tagged(fix, gnss(k)) : fix));
    }
    const auto step = navigator.step();
    if (step && step->solution) circuit.last = *step->solution;
  }
  circuit.truth = vehicle.state();
  circuit.refused = navigator.filter().counts().imu_out_of_order + navigator.filter().counts().imu_gaps;
  return circuit;
}

std::int64_t none(std::uint64_t) { return 0; }

Vector3 error_n_m(const Circuit& circuit) { return nav::ned_from(circuit.truth.position, geodetic_of(circuit.last)); }

TEST(TagTime, RightTagsGiveTheBitsOfSimTime) {
  const Circuit with = circuit(none, none), without = circuit(none, none, false);
  EXPECT_EQ(with.last.latitude_rad, without.last.latitude_rad);
  EXPECT_EQ(with.last.v_n, without.last.v_n);
  EXPECT_EQ(with.last.q_n_body.coeffs(), without.last.q_n_body.coeffs());
}

TEST(TagTime, AFixTaggedTooLateKeepsTheFilterBehindByTheWayOfThatTime) {
  // Fixes of t tagged t + 20 ms: at 10 m/s the filter believes to be 0.2 m behind. On the circle of 0.1 rad/s the chord
  // and the arc of 20 ms differ by 1e-6; a filter of 0.02 m a fix follows within a few percent.
  const Circuit late = circuit(none, [](std::uint64_t) { return 20'000'000; });
  const Vector3 ahead = late.truth.v_n.normalized();
  EXPECT_NEAR(error_n_m(late).dot(ahead), -0.2, 0.02);
  EXPECT_LT(error_n_m(circuit(none, none)).norm(), 0.01);
}

TEST(TagTime, AnOffsetThatAllSensorsShareIsNoneToTheFilter) {
  const auto late = [](std::uint64_t) { return 20'000'000; };
  EXPECT_LT(error_n_m(circuit(late, late)).norm(), 0.01);
}

TEST(TagTime, JitterOfTheImuStretchesItsIntervalsAndLosesNoSample) {
  // 0.2 ms of jitter is 4 % of an interval, of which the next takes back what the last had too much.
  const random::Stream jitter(3, "jitter");
  const Circuit jittery = circuit(
      [&](std::uint64_t k) {
        return static_cast<std::int64_t>(std::llround(2e5 * std::clamp(jitter.normal(k), -3.0, 3.0)));
      },
      none);
  EXPECT_EQ(jittery.refused, 0u);
  EXPECT_LT(error_n_m(jittery).norm(), 0.05);
}

TEST(TagTime, AnIntervalAfterAGapIsItsOwn) {
  TagTime tags;
  ImuSample first, second;
  first.header.sim_time_ns = kDt_ns;
  second.header.sim_time_ns = 3 * kDt_ns;
  first.interval_ns = second.interval_ns = kDt_ns;
  tags.applied(tagged(first, 0));
  const ImuSample after = tags.applied(tagged(second, 1'000'000));
  EXPECT_EQ(after.interval_ns, kDt_ns);
  EXPECT_EQ(after.header.sim_time_ns, 3 * kDt_ns + 1'000'000);
  second.header.sim_time_ns = 4 * kDt_ns;
  EXPECT_EQ(tags.applied(tagged(second, 0)).interval_ns, kDt_ns - 1'000'000);
}

}  // namespace tag_time_test
}  // namespace inslab::navigation
