#include "inslab/models/sensing/instrument.hpp"

#include <gtest/gtest.h>

#include "inslab/data/samples/air_pressure.hpp"

namespace inslab::sensing {
namespace {

using Barometer = Instrument<catalog::Barometer>;

Setup<catalog::Barometer> setup() {
  Setup<catalog::Barometer> setup{7, 3, time::Rate(10.0), {}, {}};
  setup.errors.target = setup.installation.target = {SensorKind::Barometer, 3};
  return setup;
}

TruthState truth_at(std::int64_t time_ns) {
  TruthState truth;
  truth.header.sim_time_ns = time_ns;
  truth.header.sequence_number = 4711;
  truth.header.publish_monotonic_ns = truth.header.publish_realtime_ns = 1;
  return truth;
}

TEST(Instrument, IsReachedAtItsInstantsAfterTheFirst) {
  Barometer instrument(setup());
  EXPECT_FALSE(instrument.reach(truth_at(0)));
  EXPECT_FALSE(instrument.reach(truth_at(50'000'000)));
  ASSERT_TRUE(instrument.reach(truth_at(100'000'000)));
  EXPECT_EQ(instrument.instant(), 1u);
  EXPECT_FALSE(instrument.reach(truth_at(150'000'000)));
  ASSERT_TRUE(instrument.reach(truth_at(200'000'000)));
  EXPECT_EQ(instrument.instant(), 2u);
}

TEST(Instrument, SamplesAreNumberedAndSayWhoseTheyAreAndUnderWhichProfiles) {
  Barometer instrument(setup());
  BarometerErrorProfile errors = setup().errors;
  errors.request.journal_number = 5;
  instrument.take(errors);
  InstallationProfile installation = setup().installation;
  installation.request.journal_number = 6;
  instrument.take(installation);
  FaultProfile fault;
  fault.target = installation.target;
  fault.request.journal_number = 7;
  instrument.take(fault);
  const auto tagged = instrument.reach(truth_at(100'000'000));
  ASSERT_TRUE(tagged);
  EXPECT_EQ(instrument.labelled<AirPressure>(*tagged).header.sequence_number, 0u);
  const auto sample = instrument.labelled<AirPressure>(*tagged);
  EXPECT_EQ(sample.header.sequence_number, 1u);
  EXPECT_EQ(sample.header.sim_time_ns, 100'000'000);
  EXPECT_EQ(sample.header.publish_monotonic_ns, 0u);
  EXPECT_EQ(sample.header.publish_realtime_ns, 0u);
  EXPECT_EQ(sample.sensor_number, 3u);
  EXPECT_EQ(sample.revisions.barometer_error, 5u);
  EXPECT_EQ(sample.revisions.installation, 6u);
  EXPECT_EQ(sample.revisions.fault, 7u);
}

TEST(Instrument, RefusesAProfileOfAnotherKindAndKeepsItsOwn) {
  Barometer instrument(setup());
  InstallationProfile other = setup().installation;
  other.target.kind = SensorKind::Gnss;
  other.lever_arm_v_m.x() = 1.0;
  EXPECT_THROW(instrument.take(other), std::invalid_argument);
  EXPECT_TRUE(instrument.installation().lever_arm_v_m.isZero(0.0));
}

TEST(Instrument, StreamsAreNamedAfterTheSensorOrSharedByTheScenario) {
  const Barometer instrument(setup());
  EXPECT_EQ(instrument.stream("pressure"), random::Stream(7, "barometer3/pressure"));
  EXPECT_EQ(instrument.shared_stream("air/temperature"), random::Stream(7, "air/temperature"));
}

}  // namespace
}  // namespace inslab::sensing
