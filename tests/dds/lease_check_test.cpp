#include "inslab/bus/dds/lease_check.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "inslab/bus/dds/fast_dds.hpp"

#ifndef INSLAB_FAST_DDS_3

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastdds/rtps/builtin/discovery/participant/PDPSimple.h>
#include <fastdds/rtps/resources/ResourceEvent.h>
#include <fastdds/rtps/resources/TimedEvent.h>

#include <chrono>
#include <thread>

namespace inslab::dds {
namespace lease_check_test {

namespace rtps = eprosima::fastrtps::rtps;

/// Called as the library calls it, by its dynamic symbol.
void look_at_the_lease_of(rtps::ParticipantProxyData& participant) {
  mend_the_lease_check();
  using Check = void (*)(rtps::PDP*, rtps::ParticipantProxyData*);
  const auto check = reinterpret_cast<Check>(
      dlsym(RTLD_DEFAULT,
            "_ZN8eprosima8fastrtps4rtps3PDP35check_remote_participant_livelinessEPNS1_20ParticipantProxyDataE"));
  ASSERT_NE(check, nullptr);
  const rtps::RTPSParticipantAllocationAttributes allocation;
  static auto* const discovery = new rtps::PDPSimple(nullptr, allocation);  // it cannot be taken down without a network
  check(discovery, &participant);
}

/// The record is the one that a participant leaves behind, its lease still to be looked at.
TEST(LeaseCheck, OfAParticipantThatHasJustLeftEndsNoProcess) {
  rtps::ParticipantProxyData left(rtps::RTPSParticipantAllocationAttributes{});
  left.should_check_lease_duration = true;
  ASSERT_EQ(left.m_guid, rtps::GUID_t::unknown());
  look_at_the_lease_of(left);
}

/// The timer of this process comes more than a second too late, as it does when the process was stopped.
TEST(LeaseCheck, AfterAStandstillOfItsOwnDropsNobodyAndBeginsAnew) {
  constexpr std::chrono::milliseconds kLease(20);
  rtps::ResourceEvent timers;
  timers.init_thread();
  rtps::ParticipantProxyData peer(rtps::RTPSParticipantAllocationAttributes{});
  peer.should_check_lease_duration = true;
  peer.m_guid.entityId = rtps::c_EntityId_RTPSParticipant;
  peer.m_leaseDuration = eprosima::fastdds::dds::Duration_t(0, 20'000'000);
  peer.assert_liveliness();
  peer.lease_duration_event = new rtps::TimedEvent(
      timers, [] { return false; }, 10'000.0);  // the record deletes it
  std::this_thread::sleep_for(kLease + std::chrono::milliseconds(1100));
  look_at_the_lease_of(peer);
  EXPECT_EQ(peer.lease_duration_event->getIntervalMilliSec(), kLease.count());
}

}  // namespace lease_check_test
}  // namespace inslab::dds

#endif
