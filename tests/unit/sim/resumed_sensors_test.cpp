// A sensor that is stopped anywhere and goes on in another process from its state puts out the same bits. The scenario
// has every stage of both models on, and swaps of every kind.

#include <gtest/gtest.h>

#include "inslab/data/state/state_stream.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/sensors.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::sim {
namespace resumed_sensors_test {

using Bytes = std::vector<std::uint8_t>;

template <class T>
void append(const T& sample, Bytes& out) {
  Bytes encoded;
  wire::encode(sample, encoded);
  out.insert(out.end(), encoded.begin(), encoded.end());
}

template <class Result>
Bytes bytes_with_truth(const Result& result) {
  Bytes bytes;
  if (result.output) {
    append(result.output->sample, bytes);
    append(result.output->truth, bytes);
  }
  for (const ProfileAck& ack : result.acks) append(ack, bytes);
  return bytes;
}
Bytes bytes_of(const Sensor<catalog::Imu>::Result& result) { return bytes_with_truth(result); }
Bytes bytes_of(const Sensor<catalog::AirData>::Result& result) { return bytes_with_truth(result); }

/// Of every kind that puts out one stream.
template <class Result>
Bytes bytes_of(const Result& result) {
  Bytes bytes;
  if (result.output) append(*result.output, bytes);
  for (const ProfileAck& ack : result.acks) append(ack, bytes);
  return bytes;
}

/// A scenario's truth and journal, once for all tests.
struct Run {
  scenario::LoadedScenario scenario;
  std::vector<TruthState> truth;
  std::vector<catalog::AnyProfile> journal;

  explicit Run(const std::string& name) : scenario(scenario::load(INSLAB_SOURCE_DIR "/" + name + ".json")) {
    TruthSource source(scenario, scenario.start(time::Nanoseconds(0)), RunId());
    for (const catalog::AnyProfile& swap : scenario.swaps)
      journal.push_back(std::get<catalog::AnyProfile>(source.submit(swap)));
    while (source.has_next()) truth.push_back(source.take());
  }
  static const Run& recovery() {
    static const Run run("tests/data/recovery");
    return run;
  }
  static const Run& two_antennas() {
    static const Run run("config/scenarios/two_antennas");
    return run;
  }
  static const Run& odd_rates() {
    static const Run run("tests/data/odd_rates");
    return run;
  }
  static const Run& magnetometer() {
    static const Run run("config/scenarios/magnetometer");
    return run;
  }
  static const Run& aiding() {
    static const Run run("config/scenarios/aiding");
    return run;
  }
  static const Run& air_data() {
    static const Run run("config/scenarios/air_data");
    return run;
  }
  static const Run& grafting() {
    static const Run run("config/scenarios/grafting");
    return run;
  }
};

/// Before and after each swap, in fades, in the outage, between the intervals of the slow IMU.
std::vector<std::size_t> stops_of(const Run& run) {
  std::vector<std::size_t> stops{0, 1, 2, 239, 260, 321};
  for (const catalog::AnyProfile& entry : run.journal) {
    const auto at = run.scenario.truth_grid().index(time::Nanoseconds(catalog::request_of(entry).apply_at_ns));
    stops.insert(stops.end(), {at - 1, at, at + 1, at + 7, at + 90});
  }
  return stops;
}

/// Runs a sensor through the whole scenario; from each truth sample in `stops` on a second one, that begins afresh with
/// the first one's state, goes with it for two seconds.
template <class Sensor, class Make>
void expect_resumes(const Run& run, const Make& make) {
  constexpr std::size_t kGoesAlong = 400;
  const std::vector<std::size_t> stops = stops_of(run);
  const auto with_journal = [&](Sensor sensor) {
    for (const catalog::AnyProfile& entry : run.journal) sensor.add(entry);
    return sensor;
  };
  Sensor first = with_journal(make(run.scenario));
  std::vector<std::pair<std::size_t, Sensor>> resumed;  // and the truth sample at which it began
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    const Bytes expected = bytes_of(first.process(run.truth[i]));
    for (auto& [stop, sensor] : resumed) {
      if (i > stop + kGoesAlong) continue;
      ASSERT_EQ(bytes_of(sensor.process(run.truth[i])), expected) << "resumed after " << stop << ", at " << i;
    }
    if (std::find(stops.begin(), stops.end(), i) == stops.end()) continue;
    Bytes state;
    state::StateWriter writer(state);
    writer(first);
    Sensor again = with_journal(make(run.scenario));
    state::StateReader reader(state.data(), state.size());
    reader(again);
    reader.expect_end();
    resumed.emplace_back(i, std::move(again));
  }
}

TEST(ResumedSensors, AnImuGoesOnWithTheSameBits) {
  expect_resumes<Sensor<catalog::Imu>>(
      Run::recovery(), [](const auto& scenario) { return Sensor<catalog::Imu>(scenario, scenario.imus[0]); });
}

TEST(ResumedSensors, AnImuSlowerThanTheTruthGoesOnWithTheSameBits) {
  expect_resumes<Sensor<catalog::Imu>>(
      Run::recovery(), [](const auto& scenario) { return Sensor<catalog::Imu>(scenario, scenario.imus[1]); });
}

TEST(ResumedSensors, AnImuWithTheErrorsOfARecordingGoesOnWithTheSameBits) {
  expect_resumes<Sensor<catalog::Imu>>(
      Run::grafting(), [](const auto& scenario) { return Sensor<catalog::Imu>(scenario, scenario.imus[0]); });
}

TEST(ResumedSensors, AReceiverGoesOnWithTheSameBits) {
  expect_resumes<Sensor<catalog::Gnss>>(
      Run::recovery(), [](const auto& scenario) { return Sensor<catalog::Gnss>(scenario, scenario.gnss[0]); });
}

TEST(ResumedSensors, AMagnetometerGoesOnWithTheSameBits) {
  expect_resumes<Sensor<catalog::Magnetometer>>(Run::magnetometer(), [](const auto& scenario) {
    return Sensor<catalog::Magnetometer>(scenario, scenario.magnetometers[0]);
  });
}

TEST(ResumedSensors, ABarometerAndOdometersGoOnWithTheSameBits) {
  expect_resumes<Sensor<catalog::Barometer>>(
      Run::aiding(), [](const auto& scenario) { return Sensor<catalog::Barometer>(scenario, scenario.barometers[0]); });
  for (const std::size_t i : {0, 1}) {
    expect_resumes<Sensor<catalog::Odometer>>(Run::aiding(), [i](const auto& scenario) {
      return Sensor<catalog::Odometer>(scenario, scenario.odometers[i]);
    });
  }
}

TEST(ResumedSensors, TwoAntennaHeadingsGoOnWithTheSameBits) {
  for (const std::size_t i : {0, 1}) {
    expect_resumes<Sensor<catalog::Heading>>(Run::two_antennas(), [i](const auto& scenario) {
      return Sensor<catalog::Heading>(scenario, scenario.headings[i]);
    });
  }
}

TEST(ResumedSensors, AirDataProbesGoOnWithTheSameBits) {
  for (const std::size_t i : {0, 1}) {
    expect_resumes<Sensor<catalog::AirData>>(Run::air_data(), [i](const auto& scenario) {
      return Sensor<catalog::AirData>(scenario, scenario.air_data[i]);
    });
  }
}

TEST(ResumedSensors, AtRatesThatDivideNoneOfTheOthersAllGoOnWithTheSameBits) {
  for (const std::size_t i : {0, 1}) {
    expect_resumes<Sensor<catalog::Imu>>(
        Run::odd_rates(), [i](const auto& scenario) { return Sensor<catalog::Imu>(scenario, scenario.imus[i]); });
  }
  expect_resumes<Sensor<catalog::Gnss>>(
      Run::odd_rates(), [](const auto& scenario) { return Sensor<catalog::Gnss>(scenario, scenario.gnss[0]); });
}

}  // namespace resumed_sensors_test
}  // namespace inslab::sim
