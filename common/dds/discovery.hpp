#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "dds/participant.hpp"

namespace inslab::dds {

/// A writer or a reader that somebody has on the network, as its announcement describes it.
struct Endpoint {
  bool is_writer = false;
  std::string topic;
  std::string type;
  std::string participant;  ///< its name; empty when it has none
  std::string guid_prefix;  ///< of the participant
  bool reliable = false;
  bool transient_local = false;
  std::vector<std::string> partitions;
  std::vector<int> representations;  ///< data representations offered or accepted; empty: XCDR1

  /// Whether it offers, or accepts, XCDR1, the one representation of this product.
  bool speaks_xcdr1() const;
};

/// Why a writer and a reader of one topic do not match; empty when they do. Source: DDS 1.4, 2.2.3 (requested against
/// offered), and the type's name.
std::string mismatch(const Endpoint& writer, const Endpoint& reader);

/// Hears what writers and readers there are, from a participant of its own without any endpoint.
class Discovery {
 public:
  /// Throws std::runtime_error as Participant does.
  explicit Discovery(const ParticipantOptions& options);
  ~Discovery();
  Discovery(const Discovery&) = delete;
  Discovery& operator=(const Discovery&) = delete;

  /// Those present now, ordered by topic.
  std::vector<Endpoint> endpoints() const;
  /// Names of the participants present now, by GUID prefix.
  std::map<std::string, std::string> participants() const;

 private:
  struct Listener;
  std::unique_ptr<Listener> listener_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
};

}  // namespace inslab::dds
