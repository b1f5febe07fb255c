#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "inslab/data/catalog/measured_channels.hpp"
#include "inslab/data/state/state_stream.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/sensors.hpp"
#include "inslab/sim/truth_source.hpp"

/// Sensors of every kind with a fault, beside the same without.
namespace inslab::sim::fault_bench {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;
inline constexpr std::int64_t kOn_ns = 2 * kSecond_ns;   // the fault comes on
inline constexpr std::int64_t kOff_ns = 6 * kSecond_ns;  // and is mended
inline bool is_on(std::int64_t sim_time_ns) { return sim_time_ns > kOn_ns && sim_time_ns <= kOff_ns; }

/// A scenario with a sensor of every kind, and ten seconds of its truth.
struct EveryKind {
  scenario::LoadedScenario scenario = scenario::load(INSLAB_SOURCE_DIR "/config/scenarios/faults.json");
  std::vector<TruthState> truth;

  EveryKind() {
    TruthSource source(scenario, scenario.start(time::Nanoseconds(0)), RunId());
    while (source.has_next() && truth.size() < 2001) truth.push_back(source.take());
  }
  static const EveryKind& run() {
    static const EveryKind every_kind;
    return every_kind;
  }
};

/// What came out at one truth sample.
template <class Sample>
struct Arrival {
  std::int64_t at_ns;
  Sample sample;
};
template <class Kind>
using Arrivals = std::vector<Arrival<catalog::FirstSampleOf<Kind>>>;

template <class Sample>
std::vector<double> measured(Sample sample) {
  std::vector<double> numbers;
  for_each_measured(sample, [&numbers](const Field&, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
      numbers.push_back(value);
    } else {
      numbers.insert(numbers.end(), value.begin(), value.end());
    }
  });
  return numbers;
}

/// The channel of each of those numbers.
inline std::vector<catalog::MeasuredChannel> channels_by_number(SensorKind kind) {
  std::vector<catalog::MeasuredChannel> by_number;
  for (const catalog::MeasuredChannel& channel : catalog::measured_channels(kind)) {
    by_number.insert(by_number.end(), channel.has_axes ? 3 : 1, channel);
  }
  return by_number;
}

/// Its bytes but for what says under which fault, as which sample and when it came.
template <class Sample>
std::vector<std::uint8_t> comparable(Sample sample) {
  sample.revisions.fault = 0;
  sample.header.sequence_number = 0;
  make_available_at(sample, 0);
  std::vector<std::uint8_t> bytes;
  wire::encode(sample, bytes);
  return bytes;
}

/// A sensor of one kind with a fault from kOn_ns to kOff_ns, and without.
template <class Kind>
struct Bench {
  Arrivals<Kind> without, with;

  explicit Bench(const CommonFaults& faults) {
    Sensor<Kind> healthy = sensor(), faulty = sensor(), resumed = sensor();
    for (Sensor<Kind>* each : {&faulty, &resumed}) {
      each->add(entry(faults, kOn_ns, 1));
      each->add(entry({}, kOff_ns, 2));
    }
    const std::vector<TruthState>& truth = EveryKind::run().truth;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      take(healthy.process(truth[i]), truth[i], without);
      const std::size_t so_far = with.size();
      auto result = faulty.process(truth[i]);
      expect_accounts(result);
      take(std::move(result), truth[i], with);
      if (i > kStop) expect_the_same(resumed, truth[i], so_far);
      if (i == kStop) go_on(faulty, resumed);
    }
  }

  /// The samples of a stretch of time by the time of validity.
  static auto by_time(const Arrivals<Kind>& arrivals) {
    std::map<std::int64_t, catalog::FirstSampleOf<Kind>> samples;
    for (const auto& arrival : arrivals) samples.emplace(arrival.sample.header.sim_time_ns, arrival.sample);
    return samples;
  }

  /// Outside of the fault every sample is there, the same but for its number.
  void expect_no_trace() const {
    const auto all = by_time(with);
    for (const auto& [time_ns, sample] : by_time(without)) {
      if (is_on(time_ns)) continue;
      ASSERT_EQ(all.count(time_ns), 1u) << time_ns;
      ASSERT_EQ(comparable(all.at(time_ns)), comparable(sample)) << time_ns;
    }
    std::uint64_t number = with.front().sample.header.sequence_number;
    for (const auto& arrival : with) ASSERT_EQ(arrival.sample.header.sequence_number, number++);
  }

 private:
  static constexpr std::size_t kStop = 811;  // in the fault, at no instant of a slower sensor

  static Sensor<Kind> sensor() {
    const EveryKind& run = EveryKind::run();
    const auto& all = scenario::sensors_of<Kind>(run.scenario);
    if (all.empty()) throw std::runtime_error("config/scenarios/faults.json lacks a " + std::string(Kind::name));
    return Sensor<Kind>(run.scenario, all.front());
  }
  static FaultProfile entry(const CommonFaults& faults, std::int64_t at_ns, std::uint32_t number) {
    FaultProfile profile;
    profile.target = {Kind::kind, 0};
    profile.request.apply_at_ns = at_ns;
    profile.request.journal_number = number;
    profile.common = faults;
    return profile;
  }
  static void take(typename Sensor<Kind>::Result result, const TruthState& truth, Arrivals<Kind>& arrivals) {
    result.put_out([&](auto& output) {
      if constexpr (std::is_same_v<std::decay_t<decltype(output)>, typename SensorModel<Kind>::Output>) {
        arrivals.push_back({truth.header.sim_time_ns, std::get<0>(SensorModel<Kind>::samples(output))});
      }
    });
  }
  static void go_on(const Sensor<Kind>& from, Sensor<Kind>& to) {
    std::vector<std::uint8_t> state;
    state::StateWriter writer(state);
    writer(from);
    state::StateReader reader(state.data(), state.size());
    reader(to);
    reader.expect_end();
  }
  void expect_the_same(Sensor<Kind>& resumed, const TruthState& truth, std::size_t from) {
    Arrivals<Kind> again;
    take(resumed.process(truth), truth, again);
    ASSERT_EQ(again.size(), with.size() - from);
    for (std::size_t i = 0; i < again.size(); ++i) {
      ASSERT_EQ(comparable(again[i].sample), comparable(with[from + i].sample)) << truth.header.sim_time_ns;
    }
  }
  /// The budgets of an IMU and of an air data probe sum to output minus truth, to the rounding of their terms.
  static void expect_accounts(typename Sensor<Kind>::Result& result) {
    if constexpr (std::is_same_v<Kind, catalog::Imu>) {
      result.put_out([](imu::ImuModel::Output& output) {
        const Vector3 dtheta = output.truth.dtheta_b + output.truth.gyro_error.sum();
        const Vector3 dv = output.truth.dv_b + output.truth.accel_error.sum();
        if (output.sample.dtheta_b.allFinite()) {
          EXPECT_LT((dtheta - output.sample.dtheta_b).norm(), 1e-15 * (1.0 + output.sample.dtheta_b.norm()));
          EXPECT_LT((dv - output.sample.dv_b).norm(), 1e-14 * (1.0 + output.sample.dv_b.norm()));
        }
        const bool acted = output.truth.active_faults != 0;
        EXPECT_TRUE(is_on(output.sample.header.sim_time_ns) || !acted);
      });
    } else if constexpr (std::is_same_v<Kind, catalog::AirData>) {
      result.put_out([](air_data::AirDataModel::Output& output) {
        if (std::isnan(output.sample.impact_pressure_pa)) return;
        const AirflowTruth& truth = output.truth;
        EXPECT_NEAR(truth.impact_pressure_pa + truth.impact_pressure_error.sum(), output.sample.impact_pressure_pa,
                    1e-8);
        EXPECT_NEAR(truth.angle_of_sideslip_rad + truth.angle_of_sideslip_error.sum(),
                    output.sample.angle_of_sideslip_rad, 1e-12);
        EXPECT_TRUE(is_on(output.sample.header.sim_time_ns) || truth.active_faults == 0);
        EXPECT_EQ(truth.header.sequence_number, output.sample.header.sequence_number);
      });
    } else {
      (void)result;
    }
  }
};

/// Calls `test(Tag<Kind>)` for every kind of sensor.
template <class Test>
void for_every_kind(const Test& test) {
  for_each(catalog::SensorKinds{}, [&](auto kind) {
    SCOPED_TRACE(std::string(decltype(kind)::type::name));
    test(kind);
  });
}

/// Runs a fault on every kind, expects no trace of it outside, and calls `expect(bench, sample without, sample with)`
/// with each pair in it.
template <class Expect>
void expect_of_each_sample(const std::function<void(CommonFaults&)>& set, const Expect& expect) {
  CommonFaults faults;
  set(faults);
  for_every_kind([&](auto kind) {
    using Kind = typename decltype(kind)::type;
    const Bench<Kind> bench(faults);
    bench.expect_no_trace();
    const auto all = Bench<Kind>::by_time(bench.with);
    int seen = 0;
    for (const auto& [time_ns, right] : Bench<Kind>::by_time(bench.without)) {
      if (!is_on(time_ns)) continue;
      ASSERT_EQ(all.count(time_ns), 1u) << time_ns;
      expect(bench, right, all.at(time_ns));
      ++seen;
    }
    EXPECT_GE(seen, 20);
  });
}

/// The last sample before the fault.
template <class Kind>
catalog::FirstSampleOf<Kind> last_before(const Bench<Kind>& bench) {
  const auto all = Bench<Kind>::by_time(bench.without);
  return std::prev(all.upper_bound(kOn_ns))->second;
}

}  // namespace inslab::sim::fault_bench
