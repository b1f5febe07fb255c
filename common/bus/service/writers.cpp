#include "inslab/bus/service/writers.hpp"

#include <spdlog/spdlog.h>

#include "inslab/bus/service/set_members.hpp"
#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::service {

namespace {

constexpr std::size_t kMostIntruders = 64;

/// What every service says of itself: left out, it changes nothing in the run, so that a service that was started by
/// mistake does not spoil it.
bool only_tells(const std::string& topic) {
  return topic == catalog::kServiceStatus.name || topic == catalog::kCredit.name || topic == catalog::kProfileAck.name;
}

}  // namespace

/// Its announcement came before anything that it has written: Fast DDS matches no writer of a stranger.
std::optional<streams::Identity> Writers::identity_of(const dds::ParticipantKey& sender) const {
  if (sender == own_key_) return own_;  // nobody is announced to itself
  const auto peer = peers_.find(sender);
  return peer ? streams::identity_in(peer->user_data) : std::nullopt;
}

std::string Writers::words_of(const dds::ParticipantKey& sender) const {
  const auto identity = identity_of(sender);
  const auto peer = peers_.find(sender);
  return (identity ? streams::words_of(*identity) + ", " : "") +
         dds::words_of(peer.value_or(dds::Peer{sender, sender == own_key_ ? "this process" : "", "", {}}));
}

bool Writers::admit(const std::string& topic, const scenario::ServiceKey& role, const dds::ParticipantKey& sender) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Stream& stream = streams_[{topic, role}];
  if (stream.owner_identity && stream.owner == sender) return true;
  if (stream.intruders.count(sender) > 0) return false;
  const auto identity = identity_of(sender);
  const std::string why = objection(stream, role, sender, identity);
  if (why.empty()) {
    if (stream.owner_identity) stream.retired.insert(stream.owner);
    stream.owner = sender;
    stream.owner_identity = identity;
    return true;
  }
  if (stream.intruders.size() < kMostIntruders) stream.intruders.insert(sender);
  const std::string words =
      topic + ": a writer that is not this set's: " + words_of(sender) + ": " + why + "; what it sends is left out";
  if (only_tells(topic)) {
    spdlog::warn("{}", words);
  } else {
    keep_fault(words);
  }
  return false;
}

bool Writers::admit_app(const std::string& topic, const dds::ParticipantKey& sender) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto [found, is_first] = app_streams_.try_emplace(topic);
  AppStream& stream = found->second;
  if (is_first) stream.owner = sender;
  if (stream.owner == sender) return true;
  if (stream.intruders.count(sender) > 0) return false;
  const bool writes_on = stream.before.count(sender) > 0;
  const dds::ParticipantKey first = writes_on ? sender : stream.owner;
  const dds::ParticipantKey second = writes_on ? stream.owner : sender;
  const auto owner = identity_of(stream.owner);
  const bool owner_lives = owner && owner->process_space == host::process_space() && lives(*owner);
  if (!writes_on && !owner_lives) {
    if (stream.before.size() < kMostIntruders) stream.before.insert(first);
    stream.owner = second;
    return true;
  }
  stream.owner = first;
  stream.before.erase(first);
  if (stream.intruders.size() < kMostIntruders) stream.intruders.insert(second);
  keep_fault(topic + ": a second writer beside " + words_of(first) + ": " + words_of(second) +
             ": an app of a unit has one process; what the second sends is left out");
  return writes_on;
}

void Writers::note_fault(const std::string& words) {
  const std::lock_guard<std::mutex> lock(mutex_);
  keep_fault(words);
}

void Writers::keep_fault(const std::string& words) {
  spdlog::error("{}", words);
  if (fault_.empty()) fault_ = words;
}

std::string Writers::objection(const Stream& stream, const scenario::ServiceKey& role,
                               const dds::ParticipantKey& sender,
                               const std::optional<streams::Identity>& identity) const {
  const std::string expected = role.first + " " + std::to_string(role.second);
  if (!identity || identity->role() != role || identity->unit != own_.unit) return "only " + expected + " may write it";
  if (const std::string differs = streams::difference(own_, *identity); !differs.empty()) return differs;
  if (stream.retired.count(sender) > 0) return "it writes on although another has taken its place";
  if (!stream.owner_identity) return "";
  const bool on_this_host = stream.owner_identity->process_space == host::process_space();
  if (on_this_host && lives(*stream.owner_identity)) return streams::words_of(*stream.owner_identity) + " writes it";
  return "";
}

std::string Writers::fault() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fault_;
}

}  // namespace inslab::service
