#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "inslab/data/state/state_stream.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/sensors.hpp"
#include "inslab/sim/truth_source.hpp"

/// The clock of every kind of sensor: the tag on the wire is wrong, sim time and all else is as without.
namespace inslab::sim {
namespace time_tags_test {

struct Run {
  scenario::LoadedScenario scenario;
  std::vector<TruthState> truth;

  explicit Run(const std::string& name) : scenario(scenario::load(INSLAB_SOURCE_DIR "/" + name + ".json")) {
    TruthSource source(scenario, scenario.start(time::Nanoseconds(0)), RunId());
    while (source.has_next() && truth.size() < 2001) truth.push_back(source.take());
  }
};

const Run& aiding() {
  static const Run run("config/scenarios/aiding");
  return run;
}
const Run& magnetic() {
  static const Run run("config/scenarios/magnetometer");
  return run;
}
const Run& air_data() {
  static const Run run("config/scenarios/air_data");
  return run;
}
const Run& two_antennas() {
  static const Run run("config/scenarios/two_antennas");
  return run;
}

/// Every error of a clock; what it makes of each sample is its own test's matter.
TimeTagErrors every_error() {
  TimeTagErrors errors;
  errors.offset_s = 0.01;
  errors.drift_ppm = 50.0;
  errors.white_sigma_s = 1e-4;
  errors.gm_sigma_s = 2e-4;
  errors.gm_correlation_time_s = 3.0;
  errors.quantization_s = 1e-5;
  errors.steps = {{1.0, 0.003}};
  return errors;
}

ImuSample& sample_of(imu::ImuModel::Output& output) { return output.sample; }
Airflow& sample_of(air_data::AirDataModel::Output& output) { return output.sample; }
template <class Output>
Output& sample_of(Output& output) {
  return output;
}

std::int64_t tag_error_ns(const Run& run, const StreamHeader& header) {
  const time::GpsTime tag{header.gps_week, header.gps_time_of_week_ns};
  return (tag - run.scenario.start(time::Nanoseconds(0))).count() - header.sim_time_ns;
}

template <class T>
std::vector<std::uint8_t> bytes_of(const T& sample) {
  std::vector<std::uint8_t> bytes;
  wire::encode(sample, bytes);
  return bytes;
}

/// A sensor with a right clock, one with a wrong one, and one that goes on in the middle with the state of the second.
template <class Kind, class Loaded>
void expect_wrong_tags(const Run& run, const Loaded& right) {
  Loaded wrong = right;
  wrong.errors.time_tag = every_error();
  Sensor<Kind> a(run.scenario, right), b(run.scenario, wrong), resumed(run.scenario, wrong);
  int samples = 0;
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    if (i == 1003) {
      std::vector<std::uint8_t> state;
      state::StateWriter writer(state);
      writer(b);
      state::StateReader reader(state.data(), state.size());
      reader(resumed);
    }
    auto without = a.process(run.truth[i]).output, with = b.process(run.truth[i]).output;
    ASSERT_EQ(without.has_value(), with.has_value());
    if (!with) {
      if (i >= 1003) {
        EXPECT_FALSE(resumed.process(run.truth[i]).output);
      }
      continue;
    }
    ++samples;
    auto& tagged = sample_of(*with);
    const auto& exact = sample_of(*without);
    if (i >= 1003) {
      auto again = resumed.process(run.truth[i]).output;
      ASSERT_TRUE(again);
      ASSERT_EQ(bytes_of(sample_of(*again)), bytes_of(tagged)) << i;
    }
    const double t_s = time::to_seconds(tagged.header.sim_time_ns);
    const double mean_s = 0.01 + 50e-6 * t_s + (t_s >= 1.0 ? 0.003 : 0.0);
    // Six sigma of both jitters, and half a count.
    EXPECT_NEAR(time::to_seconds(tag_error_ns(run, tagged.header)), mean_s, 6.0 * std::hypot(1e-4, 2e-4) + 5e-6);
    EXPECT_EQ(tagged.header.gps_time_of_week_ns % 10000, 0);
    EXPECT_EQ(tag_error_ns(run, exact.header), 0);
    tagged.header.gps_week = exact.header.gps_week;
    tagged.header.gps_time_of_week_ns = exact.header.gps_time_of_week_ns;
    EXPECT_EQ(bytes_of(tagged), bytes_of(exact)) << "but for the tag nothing changes";
    if constexpr (std::is_same_v<Kind, catalog::Imu> || std::is_same_v<Kind, catalog::AirData>) {
      EXPECT_EQ(bytes_of(with->truth), bytes_of(without->truth));
    }
  }
  EXPECT_GT(samples, 10);
}

TEST(TimeTags, OfAnImuAreWrongAlone) { expect_wrong_tags<catalog::Imu>(aiding(), aiding().scenario.imus[0]); }
TEST(TimeTags, OfAReceiverAreWrongAlone) { expect_wrong_tags<catalog::Gnss>(aiding(), aiding().scenario.gnss[0]); }
TEST(TimeTags, OfABarometerAreWrongAlone) {
  expect_wrong_tags<catalog::Barometer>(aiding(), aiding().scenario.barometers[0]);
}
TEST(TimeTags, OfAnOdometerAreWrongAlone) {
  expect_wrong_tags<catalog::Odometer>(aiding(), aiding().scenario.odometers[0]);
}
TEST(TimeTags, OfATwoAntennaHeadingAreWrongAlone) {
  expect_wrong_tags<catalog::Heading>(two_antennas(), two_antennas().scenario.headings[0]);
}
TEST(TimeTags, OfAnAirDataProbeAreWrongAlone) {
  expect_wrong_tags<catalog::AirData>(air_data(), air_data().scenario.air_data[0]);
}
TEST(TimeTags, OfAMagnetometerAreWrongAlone) {
  expect_wrong_tags<catalog::Magnetometer>(magnetic(), magnetic().scenario.magnetometers[0]);
}

}  // namespace time_tags_test
}  // namespace inslab::sim
