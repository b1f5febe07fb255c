#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/service/service_options.hpp"
#include "inslab/formats/log/log_types.hpp"

namespace inslab::client {

/// What was heard of a topic's writers and readers.
struct TopicOnBus {
  std::string type;
  int writers = 0;
  int readers = 0;
};

/// The topics heard within so many seconds, by name.
std::map<std::string, TopicOnBus> topics_on_bus(const service::NetworkOptions& network, double seconds);

/// One message that a watched topic brought.
struct WatchedMessage {
  const log::LogType& type;
  std::vector<std::uint8_t> cdr;
  std::int64_t received_realtime_ns;

  /// "header.sim_time_ns: 5000000", a line for each column that has a value; empty when it is not what its type says.
  std::string text() const;
  /// From publishing to receipt; nothing when the message does not say when it was published.
  std::optional<double> delay_s() const;
};

struct WatchOptions {
  std::string topic;
  double seconds = 5.0;
  std::uint64_t count = 0;  ///< so many messages at most; 0: as many as come
  service::NetworkOptions network;
};

struct Watched {
  std::uint64_t messages = 0;
  std::string why_nothing;  ///< when there were none
};

/// Hands every message of the topic to `each` until the time is over, `count` have come, or a signal. Throws
/// std::invalid_argument for a topic that the product does not have.
Watched watch_topic(const WatchOptions& options, const std::function<void(const WatchedMessage&)>& each);

/// The intervals between messages in the order of their receipt.
class Intervals {
 public:
  void add(std::int64_t received_realtime_ns);

  struct Figures {
    std::size_t count = 0;
    double mean_s = 0.0;
    double least_s = 0.0;
    double most_s = 0.0;
    double deviation_s = 0.0;  ///< of all of them from their mean
  };
  /// Nothing before the second message.
  std::optional<Figures> figures() const;

 private:
  std::vector<double> intervals_s_;
  std::optional<std::int64_t> last_ns_;
};

}  // namespace inslab::client
