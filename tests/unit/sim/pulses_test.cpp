#include <gtest/gtest.h>

#include <vector>

#include "inslab/data/state/state_stream.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/sensors.hpp"
#include "inslab/sim/truth_source.hpp"

/// Pulses per second of a receiver in a run: beside its fixes, which stay as they are.
namespace inslab::sim {
namespace pulses_test {

constexpr std::int64_t kSecondNs = 1'000'000'000;

/// Thirty seconds of a receiver with pulses that loses its signals from 10 s to 20 s.
struct Run {
  scenario::LoadedScenario scenario = scenario::load(INSLAB_SOURCE_DIR "/config/scenarios/pulses.json");
  std::vector<TruthState> truth;

  Run() {
    TruthSource source(scenario, scenario.start(time::Nanoseconds(0)), RunId());
    while (source.has_next()) truth.push_back(source.take());
  }
  static const Run& run() {
    static const Run run;
    return run;
  }
};

template <class T>
std::vector<std::uint8_t> bytes_of(const T& sample) {
  std::vector<std::uint8_t> bytes;
  wire::encode(sample, bytes);
  return bytes;
}

struct Heard {
  std::vector<gnss::Pulse> pulses;
  std::vector<std::vector<std::uint8_t>> fixes;
};

Heard heard(const scenario::LoadedGnss& receiver, const std::vector<FaultProfile>& faults = {}) {
  const Run& run = Run::run();
  Sensor<catalog::Gnss> sensor(run.scenario, receiver);
  for (const FaultProfile& fault : faults) sensor.add(fault);
  Heard all;
  for (const TruthState& truth : run.truth) {
    const auto result = sensor.process(truth);
    if (result.beside) all.pulses.push_back(*result.beside);
    if (result.output) all.fixes.push_back(bytes_of(*result.output));
  }
  return all;
}

TEST(Pulses, AreNumberedWithoutGapsAndBelongToTheRun) {
  const Heard all = heard(Run::run().scenario.gnss[0]);
  ASSERT_GT(all.pulses.size(), 20U);
  for (std::size_t i = 0; i < all.pulses.size(); ++i) {
    const gnss::Pulse& pulse = all.pulses[i];
    EXPECT_EQ(pulse.sample.header.sequence_number, i);
    EXPECT_EQ(pulse.truth.header.sequence_number, i);
    EXPECT_EQ(pulse.sample.header.run_id, Run::run().truth.front().header.run_id);
    EXPECT_EQ(pulse.sample.header.gps_time_of_week_ns % kSecondNs, 0);
    EXPECT_NEAR(static_cast<double>(pulse.sample.header.sim_time_ns - pulse.truth.header.sim_time_ns),
                pulse.truth.error_ns(), 0.5);
  }
}

TEST(Pulses, GoOnInAnOutageForTheHoldoverAndComeAgainWithTheFix) {
  std::vector<std::int64_t> held, all;
  for (const gnss::Pulse& pulse : heard(Run::run().scenario.gnss[0]).pulses) {
    all.push_back(pulse.truth.header.sim_time_ns / kSecondNs);
    if (pulse.sample.in_holdover) held.push_back(all.back());
  }
  // The last fix is at 10 s and the holdover 4.5 s; a second is judged by the epochs before it.
  EXPECT_EQ(held, (std::vector<std::int64_t>{11, 12, 13, 14}));
  const std::vector<std::int64_t> first_fourteen(all.begin(), all.begin() + 14);
  EXPECT_EQ(first_fourteen.front(), 1);
  EXPECT_EQ(first_fourteen.back(), 14);
  EXPECT_EQ(all[14], 21);
  EXPECT_EQ(all.back(), 29) << "that of 30 s rises when the run is over";
}

TEST(Pulses, LeaveTheFixesAsTheyAre) {
  scenario::LoadedGnss without = Run::run().scenario.gnss[0];
  without.errors.pps = {};
  const Heard none = heard(without), all = heard(Run::run().scenario.gnss[0]);
  EXPECT_TRUE(none.pulses.empty());
  EXPECT_EQ(none.fixes, all.fixes);
  EXPECT_GT(all.fixes.size(), 50U);
}

TEST(Pulses, AreSilencedByTheFaultOffAndNumberedOnBehindIt) {
  const auto fault = [](double at_s, bool off, std::uint32_t number) {
    FaultProfile profile;
    profile.target = {SensorKind::Gnss, 0};
    profile.request.apply_at_ns = time::from_seconds(at_s).count();
    profile.request.journal_number = number;
    profile.common.off = off;
    return profile;
  };
  const Heard all = heard(Run::run().scenario.gnss[0], {fault(3.5, true, 1), fault(6.5, false, 2)});
  std::vector<std::int64_t> first;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(all.pulses[i].sample.header.sequence_number, i);
    first.push_back(all.pulses[i].truth.header.sim_time_ns / kSecondNs);
  }
  EXPECT_EQ(first, (std::vector<std::int64_t>{1, 2, 3, 7, 8}));
  EXPECT_EQ(all.pulses[3].sample.revisions.fault, 2U);
}

TEST(Pulses, AreSwitchedOffAndChangedByASwap) {
  const Run& run = Run::run();
  GnssErrorProfile errors = run.scenario.gnss[0].errors;
  errors.pps.offset_ns += 5000.0;
  errors.request.apply_at_ns = 4 * kSecondNs + 1;
  errors.request.journal_number = 1;
  GnssErrorProfile off = errors;
  off.pps.on = false;
  off.request.apply_at_ns = 7 * kSecondNs + 1;
  off.request.journal_number = 2;
  Sensor<catalog::Gnss> sensor(run.scenario, run.scenario.gnss[0]);
  sensor.add(errors);
  sensor.add(off);
  std::vector<gnss::Pulse> pulses;
  for (const TruthState& truth : run.truth) {
    if (const auto result = sensor.process(truth); result.beside) pulses.push_back(*result.beside);
  }
  ASSERT_EQ(pulses.size(), 7U);
  EXPECT_EQ(pulses[3].truth.offset_ns + 5000.0, pulses[4].truth.offset_ns);
  EXPECT_EQ(pulses[4].sample.revisions.gnss_error, 1U);
}

TEST(Pulses, GoOnWithTheSameBitsInAnotherProcess) {
  const Run& run = Run::run();
  Sensor<catalog::Gnss> first(run.scenario, run.scenario.gnss[0]);
  std::vector<Sensor<catalog::Gnss>> resumed;
  std::size_t pulses = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const auto expected = first.process(run.truth[i]);
    if (expected.beside) ++pulses;
    for (auto& sensor : resumed) {
      const auto again = sensor.process(run.truth[i]);
      ASSERT_EQ(again.beside.has_value(), expected.beside.has_value()) << i;
      if (!again.beside) continue;
      ASSERT_EQ(bytes_of(again.beside->sample), bytes_of(expected.beside->sample)) << i;
      ASSERT_EQ(bytes_of(again.beside->truth), bytes_of(expected.beside->truth)) << i;
    }
    // At a second whose pulse is still to rise, and in the holdover.
    if (i != 600 && i != 2477) continue;
    std::vector<std::uint8_t> state;
    state::StateWriter writer(state);
    writer(first);
    Sensor<catalog::Gnss> again(run.scenario, run.scenario.gnss[0]);
    state::StateReader reader(state.data(), state.size());
    reader(again);
    reader.expect_end();
    resumed.push_back(std::move(again));
  }
  EXPECT_GT(pulses, 20U);
  EXPECT_EQ(resumed.size(), 2U);
}

}  // namespace pulses_test
}  // namespace inslab::sim
