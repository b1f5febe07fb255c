#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/writer_of.hpp"
#include "inslab/data/streams/identity.hpp"

namespace inslab::service {

/// Who may write the topics that one service alone writes: the process of that role in this set. One that takes the
/// place of a process that has ended is its successor. Anybody else is an intruder: what it sends is left out, and the
/// first is a fault. A topic that one app writes, whoever that is, has one writer too. May be used by several threads.
class Writers {
 public:
  /// `own`: who reads, under `own_key`.
  Writers(const dds::Peers& peers, const dds::ParticipantKey& own_key, streams::Identity own)
      : peers_(peers), own_key_(own_key), own_(std::move(own)) {}

  /// Whether a sample of `topic`, which `role` alone writes, is from its rightful writer.
  bool admit(const std::string& topic, const scenario::ServiceKey& role, const dds::ParticipantKey& sender);
  /// Whether a sample of `topic`, which one app writes, is from that one. Another may take its place. That the one
  /// before has ended is seen of a process of ours; of another's it is believed until it writes on: then the second is
  /// the intruder.
  bool admit_app(const std::string& topic, const dds::ParticipantKey& sender);

  /// A callback for a reader of a topic that hands on what its rightful writers send.
  template <class T, class Callback>
  auto only(const dds::Topic<T>& topic, const Callback& callback) {
    if constexpr (names_its_writer<T>) {
      return [this, topic = topic.name, callback](const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
        const scenario::ServiceKey role = writer_of(sample);
        if (!is_of_the_set(role.first) || admit(topic, role, dds::participant_of(origin))) callback(sample, origin);
      };
    } else {
      return [this, topic = topic.name, role = writer_of_topic<T>(topic.name), callback](
                 const dds::Received<T>& sample, const dds::SampleOrigin& origin) {
        if (admit(topic, role, dds::participant_of(origin))) callback(sample, origin);
      };
    }
  }

  /// The same for what an app writes, the navigation app or the vehicle: `topic` is that of the single samples where
  /// they come in blocks too. The navigation app is inslab-reference-nav where that takes part.
  template <class Callback>
  auto only_the_app(const std::string& topic, bool is_reference_nav, const Callback& callback) {
    return [this, topic, is_reference_nav, callback](const auto& sample, const dds::SampleOrigin& origin) {
      const dds::ParticipantKey sender = dds::participant_of(origin);
      if (is_reference_nav ? admit(topic, {catalog::kReferenceNav, 0u}, sender) : admit_app(topic, sender)) {
        callback(sample, origin);
      }
    };
  }

  /// Something else was written that must not be: said, and kept when it is the first.
  void note_fault(const std::string& words);
  /// What was written first that must not be, in words; empty when nothing was.
  std::string fault() const;

 private:
  struct Stream {
    dds::ParticipantKey owner{};
    std::optional<streams::Identity> owner_identity;  ///< nothing: nobody has written yet
    std::set<dds::ParticipantKey> retired;
    std::set<dds::ParticipantKey> intruders;
  };

  struct AppStream {
    dds::ParticipantKey owner{};
    std::set<dds::ParticipantKey> before;  ///< who wrote before the owner
    std::set<dds::ParticipantKey> intruders;
  };

  std::optional<streams::Identity> identity_of(const dds::ParticipantKey& sender) const;
  /// "inslab-imu-injector 0 (host bench, ...), 'name', GUID ..."
  std::string words_of(const dds::ParticipantKey& sender) const;
  void keep_fault(const std::string& words);
  /// Why a sender may not take over; empty when it may.
  std::string objection(const Stream& stream, const scenario::ServiceKey& role, const dds::ParticipantKey& sender,
                        const std::optional<streams::Identity>& identity) const;

  const dds::Peers& peers_;
  dds::ParticipantKey own_key_;
  streams::Identity own_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, scenario::ServiceKey>, Stream> streams_;
  std::map<std::string, AppStream> app_streams_;
  std::string fault_;
};

}  // namespace inslab::service
