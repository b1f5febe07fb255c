#include "app/writers.hpp"

#include <spdlog/spdlog.h>

#include "app/host.hpp"
#include "app/set_members.hpp"
#include "wire/topic_names.hpp"

namespace inslab::app {

namespace {

/// What every service says of itself: left out, it changes nothing in the run, so that a service that was started by
/// mistake does not spoil it.
bool only_tells(const std::string& topic) {
  return topic == wire::topic_names::kServiceStatus || topic == wire::topic_names::kCredit ||
         topic == wire::topic_names::kProfileAck;
}

}  // namespace

bool Writers::admit(const std::string& topic, const ServiceKey& role, const dds::ParticipantKey& sender) {
  constexpr std::size_t kMostIntruders = 64;
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[{topic, role}];
  if (stream.owner_identity && stream.owner == sender) return true;
  if (stream.intruders.count(sender) > 0) return false;
  // Its announcement came before anything that it has written: Fast DDS matches no writer of a stranger.
  const auto peer = peers_.find(sender);
  // Nobody hears of itself: who is no peer is the participant that reads.
  const auto identity = peer ? identity_in(peer->user_data) : std::optional<Identity>(own_);
  const std::string why = objection(stream, role, sender, identity);
  if (why.empty()) {
    if (stream.owner_identity) stream.retired.insert(stream.owner);
    stream.owner = sender;
    stream.owner_identity = identity;
    return true;
  }
  if (stream.intruders.size() < kMostIntruders) stream.intruders.insert(sender);
  const std::string who = identity ? words_of(*identity) + ", " : "";
  const std::string words = topic + ": a writer that is not this set's: " + who +
                            dds::words_of(peer.value_or(dds::Peer{sender, "", "", {}})) + ": " + why +
                            "; what it sends is left out";
  if (only_tells(topic)) {
    spdlog::warn("{}", words);
    return false;
  }
  spdlog::error("{}", words);
  if (fault_.empty()) fault_ = words;
  return false;
}

void Writers::note_fault(const std::string& words) {
  const std::lock_guard<std::mutex> lock(mutex_);
  spdlog::error("{}", words);
  if (fault_.empty()) fault_ = words;
}

std::string Writers::objection(const Stream& stream, const ServiceKey& role, const dds::ParticipantKey& sender,
                               const std::optional<Identity>& identity) const {
  const std::string expected = role.first + " " + std::to_string(role.second);
  if (!identity || identity->role() != role || identity->unit != own_.unit) return "only " + expected + " may write it";
  if (const std::string differs = difference(own_, *identity); !differs.empty()) return differs;
  if (stream.retired.count(sender) > 0) return "it writes on although another has taken its place";
  if (!stream.owner_identity) return "";
  const bool on_this_host = stream.owner_identity->process_space == process_space();
  if (on_this_host && lives(*stream.owner_identity)) return words_of(*stream.owner_identity) + " writes it";
  return "";
}

std::string Writers::fault() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fault_;
}

}  // namespace inslab::app
