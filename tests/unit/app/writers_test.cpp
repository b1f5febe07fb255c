#include "app/writers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/host.hpp"

namespace inslab::app {
namespace writers_test {

using testing::HasSubstr;

class WritersOfAStream : public testing::Test {
 protected:
  static constexpr const char* kTopic = "inslab/imu/0";
  static inline const ServiceKey kInjector{kImuInjector, 0u};

  static Identity identity(const char* service, std::uint32_t pid, const std::string& space = "another host") {
    Identity one;
    one.service = service;
    one.host = "bench";
    one.process_space = space;
    one.pid = pid;
    one.scenario = "demo";
    one.scenario_hash = "1";
    return one;
  }
  dds::ParticipantKey joins(std::uint8_t number, const std::optional<Identity>& who, const char* name = "someone") {
    dds::ParticipantKey key{};
    key.fill(number);
    peers_.note({key, name, "10.0.0.9", who ? announced(*who) : std::vector<std::uint8_t>{}});
    return key;
  }

  dds::Peers peers_;
  Writers writers_{peers_, identity(kTruthLogger, 1)};
};

TEST_F(WritersOfAStream, IsTheServiceOfItsRole) {
  const auto injector = joins(1, identity(kImuInjector, 2));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, injector));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, injector));
  EXPECT_EQ(writers_.fault(), "");
}

TEST_F(WritersOfAStream, IsTheReaderItselfWhereItsRoleWrites) {
  dds::ParticipantKey own{};
  own.fill(9);  // no participant hears of itself
  EXPECT_TRUE(writers_.admit("inslab/service_status", {kTruthLogger, 0u}, own));
  EXPECT_EQ(writers_.fault(), "");
}

TEST_F(WritersOfAStream, AStrangerIsAFaultAtItsFirstSampleBeforeAndAfterTheRightfulOne) {
  const auto foe = joins(7, std::nullopt, "foe");
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, foe));
  EXPECT_THAT(writers_.fault(), HasSubstr("inslab/imu/0: a writer that is not this set's: 'foe', GUID "
                                          "07.07.07.07.07.07.07.07.07.07.07.07, at 10.0.0.9: only inslab-imu-injector "
                                          "0 may write it"));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, joins(1, identity(kImuInjector, 2))));
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, foe));
}

TEST_F(WritersOfAStream, WhatAStrangerSaysOfItselfIsLeftOutAndSpoilsNothing) {
  const auto foe = joins(7, std::nullopt, "foe");
  for (const char* topic : {"inslab/service_status", "inslab/credit", "inslab/profile_ack"}) {
    EXPECT_FALSE(writers_.admit(topic, kInjector, foe));
  }
  EXPECT_EQ(writers_.fault(), "");
}

TEST_F(WritersOfAStream, OfAnotherRoleUnitOrScenarioIsAFaultThatNamesIt) {
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(2, identity(kGnssEmulator, 5))));
  EXPECT_THAT(writers_.fault(), HasSubstr("inslab-gnss-emulator 0 (host bench, process 5"));
  Identity elsewhere = identity(kImuInjector, 6);
  elsewhere.unit = "other";
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(3, elsewhere)));
  Identity of_another_scenario = identity(kImuInjector, 7);
  of_another_scenario.scenario_hash = "2";
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(4, of_another_scenario)));
}

TEST_F(WritersOfAStream, ASuccessorMayFollowButNotBesideTheOneBefore) {
  const auto first = joins(1, identity(kImuInjector, 2));
  const auto second = joins(2, identity(kImuInjector, 3));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, first));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, second));
  EXPECT_EQ(writers_.fault(), "");
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, first));
  EXPECT_THAT(writers_.fault(), HasSubstr("it writes on although another has taken its place"));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, second));
}

TEST_F(WritersOfAStream, WhereTheProcessIsSeenToLiveNobodyTakesItsPlace) {
  Identity living = identity(kImuInjector, process_id(), process_space());
  living.started_ticks = *started_ticks(process_id());
  const auto first = joins(1, living);
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, first));
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(2, identity(kImuInjector, 3))));
  EXPECT_THAT(writers_.fault(), HasSubstr("writes it"));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, first));
}

TEST_F(WritersOfAStream, TopicsAndClaimsHaveTheirServices) {
  EXPECT_EQ(writer_of_topic<TruthState>("inslab/truth"), (ServiceKey{kTrajectoryServer, 0u}));
  EXPECT_EQ(writer_of_topic<ImuSample>("inslab/imu/12"), (ServiceKey{kImuInjector, 12u}));
  EXPECT_EQ(writer_of_topic<Block<ImuTruth>>("inslab/block/imu_truth/3"), (ServiceKey{kImuInjector, 3u}));
  EXPECT_EQ(writer_of_topic<GnssFix>("inslab/gnss/1"), (ServiceKey{kGnssEmulator, 1u}));
  EXPECT_EQ(writer_of_topic<SimStatus>("inslab/sim/status"), (ServiceKey{kTrajectoryServer, 0u}));
  ProfileAck ack;
  ack.service = kGnssEmulator;
  ack.target.number = 2;
  EXPECT_EQ(writer_of(ack), (ServiceKey{kGnssEmulator, 2u}));
  ack.service = kTrajectoryServer;
  EXPECT_EQ(writer_of(ack), (ServiceKey{kTrajectoryServer, 0u}));
}

}  // namespace writers_test
}  // namespace inslab::app
