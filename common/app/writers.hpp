#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "app/identity.hpp"
#include "app/writer_of.hpp"
#include "dds/reader.hpp"

namespace inslab::app {

/// Who may write the topics that one service alone writes: the process of that role in this set. One that takes the
/// place of a process that has ended is its successor. Anybody else is an intruder: what it sends is left out, and the
/// first is a fault. May be used by several threads.
class Writers {
 public:
  /// `own`: who reads.
  Writers(const dds::Peers& peers, Identity own) : peers_(peers), own_(std::move(own)) {}

  /// Whether a sample of `topic`, which `role` alone writes, is from its rightful writer.
  bool admit(const std::string& topic, const ServiceKey& role, const dds::ParticipantKey& sender);

  /// A callback for a reader of a topic that hands on what its rightful writers send.
  template <class T, class Callback>
  auto only(const dds::Topic<T>& topic, Callback callback) {
    if constexpr (names_its_writer<T>) {
      return [this, topic = topic.name, callback](const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
        const ServiceKey role = writer_of(sample);
        if (!is_of_the_set(role.first) || admit(topic, role, dds::participant_of(origin))) callback(sample, origin);
      };
    } else {
      return [this, topic = topic.name, role = writer_of_topic<T>(topic.name), callback](
                 const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
        if (admit(topic, role, dds::participant_of(origin))) callback(sample, origin);
      };
    }
  }

  /// Something else was written that must not be: said, and kept when it is the first.
  void note_fault(const std::string& words);
  /// What was written first that must not be, in words; empty when nothing was.
  std::string fault() const;

 private:
  struct Stream {
    dds::ParticipantKey owner{};
    std::optional<Identity> owner_identity;  ///< nothing: nobody has written yet
    std::set<dds::ParticipantKey> retired;
    std::set<dds::ParticipantKey> intruders;
  };

  /// Why a sender may not take over; empty when it may.
  std::string objection(const Stream& stream, const ServiceKey& role, const dds::ParticipantKey& sender,
                        const std::optional<Identity>& identity) const;

  const dds::Peers& peers_;
  Identity own_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, ServiceKey>, Stream> streams_;
  std::string fault_;
};

}  // namespace inslab::app
