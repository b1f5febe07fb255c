// The lease check of Fast DDS 2.9.1, but for its mistakes. The library calls it by its dynamic symbol, and a program's
// own definition of that goes before the library's. Fast DDS 3 is left as it is.

#include "inslab/bus/dds/lease_check.hpp"

#include "inslab/bus/dds/fast_dds.hpp"

#ifndef INSLAB_FAST_DDS_3

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastdds/rtps/builtin/discovery/participant/PDP.h>
#include <fastdds/rtps/resources/TimedEvent.h>

#include <chrono>
#include <mutex>

/// Called by the timer of one participant's lease: drops the participant when nothing has been heard of it for that
/// long, else comes again when that would be. Another thread may just have removed the participant and made its record
/// ready for the next one; the library takes such a record for one that cannot be. And a timer that comes much too late
/// shows that this process stood still, and has not listened: the library would drop everybody, while in another thread
/// their messages come and they are found again, and of whoever is found and dropped at once a half remains.
void eprosima::fastrtps::rtps::PDP::check_remote_participant_liveliness(ParticipantProxyData* participant) {
  std::unique_lock<std::recursive_mutex> lock(*mp_mutex);
  const GUID_t guid = participant->m_guid;
  if (!participant->should_check_lease_duration || guid == GUID_t::unknown()) return;
  const std::chrono::nanoseconds lease(participant->m_leaseDuration.to_ns());
  constexpr std::chrono::seconds kStandstill(1);
  auto left = participant->last_received_message_tm() + lease - std::chrono::steady_clock::now();
  if (left < -kStandstill) {
    left = lease;
  } else if (left < left.zero()) {
    lock.unlock();
    remove_remote_participant(guid, ParticipantDiscoveryInfo::DROPPED_PARTICIPANT);
    return;
  }
  participant->lease_duration_event->update_interval_millisec(
      static_cast<double>(std::chrono::duration_cast<std::chrono::milliseconds>(left).count()));
  participant->lease_duration_event->restart_timer();
}

#endif

void inslab::dds::mend_the_lease_check() {}
