#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "inslab/bus/dds/endpoint.hpp"
#include "inslab/bus/dds/participant.hpp"

namespace inslab::dds {

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
