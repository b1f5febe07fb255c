#include "inslab/bus/service/set_members.hpp"

#include <thread>

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::service {

namespace {

/// Those who are there answer an announcement at once; announcements that get lost are repeated every 100 ms at first.
/// A discovery server passes on what it hears every half second.
time::Nanoseconds time_to_hear(const dds::Participant& participant) {
  return std::chrono::milliseconds(participant.options().discovery_server.empty() ? 1000 : 1500);
}

std::string refusal(const streams::Identity& other, const std::string& reason, const std::string& advice) {
  return streams::words_of(other) + " " + reason + (other.unit.empty() ? "" : " in the unit '" + other.unit + "'") +
         "; " + advice;
}

}  // namespace

bool lives(const streams::Identity& identity) {
  if (identity.process_space != host::process_space()) return true;
  return host::started_ticks(identity.pid) == identity.started_ticks;
}

std::vector<streams::Identity> members_of(const dds::Participant& participant, const std::string& unit) {
  std::vector<streams::Identity> members;
  for (const dds::Peer& peer : participant.peers().all()) {
    const auto identity = streams::identity_in(peer.user_data);
    if (identity && identity->unit == unit && lives(*identity)) members.push_back(*identity);
  }
  return members;
}

void look_around(const dds::Participant& participant, const streams::Identity& own,
                 const std::function<bool(const streams::Identity& other)>& is_in_the_way) {
  constexpr time::Nanoseconds kLook = std::chrono::milliseconds(10);
  const time::Nanoseconds end = host::monotonic_now() + time_to_hear(participant);
  while (host::monotonic_now() < end && !host::shutdown_requested()) {
    for (const streams::Identity& other : members_of(participant, own.unit)) {
      if (!is_in_the_way(other) || !streams::must_yield(own, other)) continue;
      throw PlaceTaken(refusal(other, "runs here already",
                               "a unit has one set: stop that one, or choose another --unit or --domain"));
    }
    std::this_thread::sleep_for(kLook);
  }
}

void look_around(const dds::Participant& participant, const streams::Identity& own) {
  look_around(participant, own, [&own](const streams::Identity& other) {
    if (other.role() == own.role()) return true;
    if (other.service != catalog::kTrajectoryServer) return false;
    const std::string why = streams::difference(own, other);
    if (why.empty()) return false;
    throw PlaceTaken(refusal(other, "runs another set than this " + own.service + ": " + why,
                             "start this one with the scenario of that set, or with another --unit or --domain"));
  });
}

}  // namespace inslab::service
