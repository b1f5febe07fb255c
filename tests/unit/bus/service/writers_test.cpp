#include "inslab/bus/service/writers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/foundation/host/host.hpp"

namespace inslab::service {
namespace writers_test {

using testing::HasSubstr;

class WritersOfAStream : public testing::Test {
 protected:
  static constexpr const char* kTopic = "inslab/imu/0";
  static inline const scenario::ServiceKey kInjector{catalog::Imu::service, 0u};

  static streams::Identity identity(const char* service, std::uint32_t pid, const std::string& space = "another host") {
    streams::Identity one;
    one.service = service;
    one.host = "bench";
    one.process_space = space;
    one.pid = pid;
    one.scenario = "demo";
    one.scenario_hash = "1";
    return one;
  }
  dds::ParticipantKey joins(std::uint8_t number, const std::optional<streams::Identity>& who,
                            const char* name = "someone") {
    dds::ParticipantKey key{};
    key.fill(number);
    peers_.note({key, name, "10.0.0.9", who ? streams::announced(*who) : std::vector<std::uint8_t>{}});
    return key;
  }

  static constexpr dds::ParticipantKey kOwn{9, 9, 9};

  dds::Peers peers_;
  Writers writers_{peers_, kOwn, identity(catalog::kTruthLogger, 1)};
};

TEST_F(WritersOfAStream, IsTheServiceOfItsRole) {
  const auto injector = joins(1, identity(catalog::Imu::service, 2));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, injector));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, injector));
  EXPECT_EQ(writers_.fault(), "");
}

TEST_F(WritersOfAStream, IsTheReaderItselfWhereItsRoleWrites) {
  EXPECT_TRUE(writers_.admit("inslab/service_status", {catalog::kTruthLogger, 0u}, kOwn));
  EXPECT_EQ(writers_.fault(), "");
}

TEST_F(WritersOfAStream, IsNotWhoeverHasLeftTheNetworkInTheReadersName) {
  dds::ParticipantKey gone{};
  gone.fill(5);
  EXPECT_FALSE(writers_.admit("inslab/truth", {catalog::kTruthLogger, 0u}, gone));
  EXPECT_THAT(writers_.fault(), HasSubstr("05.05.05"));
}

TEST_F(WritersOfAStream, OfAnAppIsOneProcessAndOneThatTakesItsPlaceWhenItHasGone) {
  const auto first = joins(1, std::nullopt, "app");
  EXPECT_TRUE(writers_.admit_app("inslab/nav", first));
  peers_.forget(first);
  const auto second = joins(2, std::nullopt, "app");
  EXPECT_TRUE(writers_.admit_app("inslab/nav", second));
  const auto killed_and_started_again = joins(3, std::nullopt, "app");  // DDS knows the second for a while
  EXPECT_TRUE(writers_.admit_app("inslab/nav", killed_and_started_again));
  EXPECT_EQ(writers_.fault(), "");
  EXPECT_TRUE(writers_.admit_app("inslab/vehicle_state", first));
}

TEST_F(WritersOfAStream, OfAnAppTheSecondIsAFaultAsSoonAsBothAreSeenToWrite) {
  const auto first = joins(1, std::nullopt, "app");
  const auto second = joins(2, std::nullopt, "other app");
  EXPECT_TRUE(writers_.admit_app("inslab/nav", first));
  EXPECT_TRUE(writers_.admit_app("inslab/nav", second));
  EXPECT_TRUE(writers_.admit_app("inslab/nav", first));
  EXPECT_THAT(writers_.fault(), HasSubstr("inslab/nav: a second writer beside 'app', GUID 01.01"));
  EXPECT_THAT(writers_.fault(), HasSubstr(": 'other app', GUID 02.02"));
  EXPECT_FALSE(writers_.admit_app("inslab/nav", second));
  EXPECT_TRUE(writers_.admit_app("inslab/nav", first));
}

TEST_F(WritersOfAStream, OfAnAppBesideAProcessThatIsSeenToLiveTheSecondIsAFaultAtItsFirstSample) {
  streams::Identity living = identity(catalog::kReferenceNav, host::process_id(), host::process_space());
  living.started_ticks = *host::started_ticks(host::process_id());
  EXPECT_TRUE(writers_.admit_app("inslab/nav", joins(1, living)));
  EXPECT_FALSE(writers_.admit_app("inslab/nav", joins(2, std::nullopt, "app")));
  EXPECT_THAT(writers_.fault(), HasSubstr("a second writer beside inslab-reference-nav 0"));
}

TEST_F(WritersOfAStream, OfASetIsKnownToWhoHasNoScenarioOfItsOwn) {
  streams::Identity client;
  client.service = "inslab-swap";
  Writers writers(peers_, kOwn, client);
  EXPECT_TRUE(writers.admit("inslab/sim/status", {catalog::kTrajectoryServer, 0u},
                            joins(1, identity(catalog::kTrajectoryServer, 2))));
  streams::Identity elsewhere = identity(catalog::kTrajectoryServer, 3);
  elsewhere.unit = "other";
  EXPECT_FALSE(writers.admit("inslab/sim/status", {catalog::kTrajectoryServer, 0u}, joins(2, elsewhere)));
  EXPECT_FALSE(writers.admit("inslab/sim/status", {catalog::kTrajectoryServer, 0u}, joins(3, std::nullopt, "foe")));
}

TEST_F(WritersOfAStream, WithoutAScenarioAreNotOfASetThatHasOne) {
  streams::Identity without = identity(catalog::Imu::service, 3);
  without.scenario_hash.clear();
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(1, without)));
}

TEST_F(WritersOfAStream, AStrangerIsAFaultAtItsFirstSampleBeforeAndAfterTheRightfulOne) {
  const auto foe = joins(7, std::nullopt, "foe");
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, foe));
  EXPECT_THAT(writers_.fault(), HasSubstr("inslab/imu/0: a writer that is not this set's: 'foe', GUID "
                                          "07.07.07.07.07.07.07.07.07.07.07.07, at 10.0.0.9: only inslab-imu-injector "
                                          "0 may write it"));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, joins(1, identity(catalog::Imu::service, 2))));
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
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(2, identity(catalog::Gnss::service, 5))));
  EXPECT_THAT(writers_.fault(), HasSubstr("inslab-gnss-emulator 0 (host bench, process 5"));
  streams::Identity elsewhere = identity(catalog::Imu::service, 6);
  elsewhere.unit = "other";
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(3, elsewhere)));
  streams::Identity of_another_scenario = identity(catalog::Imu::service, 7);
  of_another_scenario.scenario_hash = "2";
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(4, of_another_scenario)));
}

TEST_F(WritersOfAStream, ASuccessorMayFollowButNotBesideTheOneBefore) {
  const auto first = joins(1, identity(catalog::Imu::service, 2));
  const auto second = joins(2, identity(catalog::Imu::service, 3));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, first));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, second));
  EXPECT_EQ(writers_.fault(), "");
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, first));
  EXPECT_THAT(writers_.fault(), HasSubstr("it writes on although another has taken its place"));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, second));
}

TEST_F(WritersOfAStream, WhereTheProcessIsSeenToLiveNobodyTakesItsPlace) {
  streams::Identity living = identity(catalog::Imu::service, host::process_id(), host::process_space());
  living.started_ticks = *host::started_ticks(host::process_id());
  const auto first = joins(1, living);
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, first));
  EXPECT_FALSE(writers_.admit(kTopic, kInjector, joins(2, identity(catalog::Imu::service, 3))));
  EXPECT_THAT(writers_.fault(), HasSubstr("writes it"));
  EXPECT_TRUE(writers_.admit(kTopic, kInjector, first));
}

TEST_F(WritersOfAStream, TopicsAndClaimsHaveTheirServices) {
  EXPECT_EQ(writer_of_topic<TruthState>("inslab/truth"), (scenario::ServiceKey{catalog::kTrajectoryServer, 0u}));
  EXPECT_EQ(writer_of_topic<ImuSample>("inslab/imu/12"), (scenario::ServiceKey{catalog::Imu::service, 12u}));
  EXPECT_EQ(writer_of_topic<Block<ImuTruth>>("inslab/block/imu_truth/3"),
            (scenario::ServiceKey{catalog::Imu::service, 3u}));
  EXPECT_EQ(writer_of_topic<GnssFix>("inslab/gnss/1"), (scenario::ServiceKey{catalog::Gnss::service, 1u}));
  EXPECT_EQ(writer_of_topic<SimStatus>("inslab/sim/status"), (scenario::ServiceKey{catalog::kTrajectoryServer, 0u}));
  ProfileAck ack;
  ack.service = catalog::Gnss::service;
  ack.target.number = 2;
  EXPECT_EQ(writer_of(ack), (scenario::ServiceKey{catalog::Gnss::service, 2u}));
  ack.service = catalog::kTrajectoryServer;
  EXPECT_EQ(writer_of(ack), (scenario::ServiceKey{catalog::kTrajectoryServer, 0u}));
}

}  // namespace writers_test
}  // namespace inslab::service
