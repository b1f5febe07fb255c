#include "inslab/bus/dds/lease_check.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "inslab/bus/dds/fast_dds.hpp"

#ifndef INSLAB_FAST_DDS_3

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastdds/rtps/builtin/discovery/participant/PDPSimple.h>

namespace inslab::dds {
namespace lease_check_test {

namespace rtps = eprosima::fastrtps::rtps;

/// Called as the library calls it, by its dynamic symbol: the record is the one that a participant leaves behind, its
/// lease still to be looked at.
TEST(LeaseCheck, OfAParticipantThatHasJustLeftEndsNoProcess) {
  mend_the_lease_check();
  using Check = void (*)(rtps::PDP*, rtps::ParticipantProxyData*);
  const auto check = reinterpret_cast<Check>(
      dlsym(RTLD_DEFAULT,
            "_ZN8eprosima8fastrtps4rtps3PDP35check_remote_participant_livelinessEPNS1_20ParticipantProxyDataE"));
  ASSERT_NE(check, nullptr);
  const rtps::RTPSParticipantAllocationAttributes allocation;
  static auto* const discovery = new rtps::PDPSimple(nullptr, allocation);  // it cannot be taken down without a network
  rtps::ParticipantProxyData left(allocation);
  left.should_check_lease_duration = true;
  ASSERT_EQ(left.m_guid, rtps::GUID_t::unknown());
  check(discovery, &left);
}

}  // namespace lease_check_test
}  // namespace inslab::dds

#endif
