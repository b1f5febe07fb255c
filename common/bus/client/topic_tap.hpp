#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inslab/bus/dds/participant.hpp"
#include "inslab/formats/log/log_types.hpp"

namespace inslab::client {

/// One message of a topic, whatever its type.
struct TappedMessage {
  const log::LogType& type;
  const std::vector<std::uint8_t>& cdr;  ///< encapsulation included
  std::int64_t received_realtime_ns;
};

/// Listens to one of the product's topics by its name, to a stream also where it comes in blocks. Its readers are
/// best-effort ones: what they miss nobody sends again. The participant looks on (dds::ParticipantOptions), so that a
/// producer takes them for no app that it has to serve.
class TopicTap {
 public:
  /// The callback runs in a thread of Fast DDS. Throws std::invalid_argument, naming the topics there are, when the
  /// product has none of that name.
  TopicTap(dds::Participant& participant, const std::string& topic,
           const std::function<void(const TappedMessage&)>& callback);

  /// How many writers of the topic are heard.
  int matched_writers() const { return matched_writers_(); }

 private:
  std::shared_ptr<void> samples_;
  std::shared_ptr<void> blocks_;
  std::function<int()> matched_writers_;
};

}  // namespace inslab::client
