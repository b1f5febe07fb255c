// Kinds of sensor times faults that every kind may have, from the catalogue: what each does to the samples while it is
// on, and that nothing is left of it afterwards.

#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "tests/unit/sim/fault_bench.hpp"

namespace inslab::sim {
namespace common_faults_test {

using namespace fault_bench;

/// Which samples of each kind come out, and are valid, while a fault is on that leaves some out.
void expect_left_out(const std::function<void(CommonFaults&)>& set,
                     const std::function<bool(std::int64_t, const time::Rate&)>& comes) {
  CommonFaults faults;
  set(faults);
  for_every_kind([&](auto kind) {
    using Kind = typename decltype(kind)::type;
    const Bench<Kind> bench(faults);
    bench.expect_no_trace();
    const time::Rate rate = scenario::sensors_of<Kind>(EveryKind::run().scenario).front().rate;
    const auto all = Bench<Kind>::by_time(bench.with);
    for (const auto& [time_ns, right] : Bench<Kind>::by_time(bench.without)) {
      if (!is_on(time_ns)) continue;
      const auto found = all.find(time_ns);
      if (comes(time_ns, rate)) {
        ASSERT_NE(found, all.end()) << time_ns;
        EXPECT_EQ(comparable(found->second), comparable(right)) << time_ns;
      } else if constexpr (Kind::sets_the_pace) {
        ASSERT_NE(found, all.end()) << time_ns;
        EXPECT_FALSE(found->second.gyro_valid || found->second.accel_valid) << time_ns;
        EXPECT_TRUE(found->second.dtheta_b.isZero(0.0) && found->second.dv_b.isZero(0.0)) << time_ns;
      } else {
        EXPECT_EQ(found, all.end()) << time_ns;
      }
    }
  });
}

TEST(CommonFaults, OffLeavesOutEverySample) {
  expect_left_out([](CommonFaults& faults) { faults.off = true; },
                  [](std::int64_t, const time::Rate&) { return false; });
}

TEST(CommonFaults, ADividedRateKeepsOneInstantInSoMany) {
  expect_left_out([](CommonFaults& faults) { faults.rate_divisor = 3; },
                  [](std::int64_t time_ns, const time::Rate& rate) {
                    return std::llround(1e-9 * static_cast<double>(time_ns) * rate.hz()) % 3 == 0;
                  });
}

TEST(CommonFaults, WhatIsIntermittentIsOnInTheFirstPartOfEachPeriod) {
  expect_left_out(
      [](CommonFaults& faults) {
        faults.off = true;
        faults.intermittent_period_s = 1.5;
        faults.intermittent_duty = 0.4;
      },
      [](std::int64_t time_ns, const time::Rate&) { return (time_ns - kOn_ns) % 1'500'000'000 >= 600'000'000; });
}

TEST(CommonFaults, AStuckSensorRepeatsTheLastValuesWithTagsThatGoOn) {
  expect_of_each_sample([](CommonFaults& faults) { faults.stuck = true; },
                        [](const auto& bench, const auto& right, const auto& shown) {
                          ASSERT_EQ(measured(shown), measured(last_before(bench)));
                          ASSERT_EQ(shown.header.gps_time_of_week_ns, right.header.gps_time_of_week_ns);
                        });
}

TEST(CommonFaults, AFrozenTagRepeatsTheLastOneWithValuesThatGoOn) {
  expect_of_each_sample([](CommonFaults& faults) { faults.frozen_time_tag = true; },
                        [](const auto& bench, const auto& right, auto shown) {
                          ASSERT_EQ(shown.header.gps_time_of_week_ns, last_before(bench).header.gps_time_of_week_ns);
                          shown.header.gps_time_of_week_ns = right.header.gps_time_of_week_ns;
                          ASSERT_EQ(comparable(shown), comparable(right));
                        });
}

TEST(CommonFaults, NotANumberIsInEveryMeasuredValue) {
  expect_of_each_sample([](CommonFaults& faults) { faults.not_a_number = true; },
                        [](const auto&, const auto&, const auto& shown) {
                          for (const double number : measured(shown)) ASSERT_TRUE(std::isnan(number));
                        });
}

TEST(CommonFaults, OutOfRangeIsBeyondWhatSuchASensorCanShowByAsMuchAsItCan) {
  expect_of_each_sample(
      [](CommonFaults& faults) { faults.out_of_range = true; },
      [](const auto&, const auto& right, const auto& shown) {
        using Sample = std::decay_t<decltype(right)>;
        const auto channels = channels_by_number(catalog::SourceOf<Sample>::kind);
        const std::vector<double> good = measured(right), bad = measured(shown);
        for (std::size_t i = 0; i < bad.size(); ++i) {
          ASSERT_TRUE(good[i] >= channels[i].least_shown && good[i] <= channels[i].most_shown) << channels[i].name;
          ASSERT_DOUBLE_EQ(bad[i] - channels[i].most_shown, channels[i].most_shown - channels[i].least_shown);
        }
      });
}

/// Uniform over a range: the mean of n is within five sigma, range / sqrt(12 n), of its middle.
TEST(CommonFaults, GarbageIsUniformOverWhatSuchASensorCanShow) {
  std::map<SensorKind, std::vector<std::vector<double>>> shares;
  expect_of_each_sample([](CommonFaults& faults) { faults.garbage = true; },
                        [&shares](const auto&, const auto& right, const auto& shown) {
                          using Sample = std::decay_t<decltype(right)>;
                          constexpr SensorKind kind = catalog::SourceOf<Sample>::kind;
                          const auto channels = channels_by_number(kind);
                          const std::vector<double> numbers = measured(shown);
                          shares[kind].resize(numbers.size());
                          for (std::size_t i = 0; i < numbers.size(); ++i) {
                            const double range = channels[i].most_shown - channels[i].least_shown;
                            shares[kind][i].push_back((numbers[i] - channels[i].least_shown) / range);
                          }
                        });
  for (const auto& [kind, of_a_kind] : shares) {
    std::set<double> means;
    for (const std::vector<double>& each : of_a_kind) {
      for (const double share : each) ASSERT_TRUE(share >= 0.0 && share <= 1.0);
      const auto n = static_cast<double>(each.size());
      const double mean = std::accumulate(each.begin(), each.end(), 0.0) / n;
      EXPECT_NEAR(mean, 0.5, 5.0 / std::sqrt(12.0 * n)) << enum_name(kind);
      means.insert(mean);
    }
    EXPECT_EQ(means.size(), of_a_kind.size()) << "every value has draws of its own";
  }
}

TEST(CommonFaults, DelayedSamplesComeLaterInTheirOrderAndTheRestWhenItEnds) {
  CommonFaults faults;
  faults.delay_s = 0.3;
  for_every_kind([&](auto kind) {
    using Kind = typename decltype(kind)::type;
    const Bench<Kind> bench(faults);
    bench.expect_no_trace();
    ASSERT_EQ(bench.with.size(), bench.without.size());
    for (std::size_t i = 0; i < bench.with.size(); ++i) {
      const auto& [at_ns, shown] = bench.with[i];
      const auto& right = bench.without[i].sample;
      ASSERT_EQ(comparable(shown), comparable(right)) << "all but when it comes";
      const std::int64_t valid_ns = right.header.sim_time_ns;
      const std::int64_t late_ns = is_on(valid_ns) ? std::min(valid_ns + 300'000'000, kOff_ns + 5'000'000) : valid_ns;
      ASSERT_EQ(at_ns, std::max(late_ns, valid_ns));
      ASSERT_EQ(available_at_ns(shown) - available_at_ns(right), at_ns - valid_ns) << valid_ns;
    }
  });
}

}  // namespace common_faults_test
}  // namespace inslab::sim
