#include "inslab/bus/client/topic_tap.hpp"

#include <mutex>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/seen_numbers.hpp"
#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/data/catalog/topics.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::client {

namespace {

using Callback = std::function<void(const TappedMessage&)>;

template <class T>
constexpr bool is_block = false;
template <class T>
constexpr bool is_block<Block<T>> = true;

template <class T, class = void>
constexpr bool has_stream_header = false;
template <class T>
constexpr bool has_stream_header<T, std::void_t<decltype(std::declval<T>().header)>> = true;

/// Which samples of a stream have come, singly or in blocks: what is sent again is told once.
class Told {
 public:
  /// True the first time a sample comes.
  bool insert(const StreamHeader& header) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (header.run_id != run_) numbers_ = {};
    run_ = header.run_id;
    return numbers_.insert(header.sequence_number);
  }

 private:
  std::mutex mutex_;
  RunId run_;
  dds::SeenNumbers numbers_;
};

template <class T>
bool is_news(Told& told, const T& sample) {
  if constexpr (has_stream_header<T>) return told.insert(sample.header);
  return true;
}

template <class T>
std::shared_ptr<dds::Reader<T>> reader_of(dds::Participant& participant, const dds::Topic<T>& topic,
                                          const log::LogType& type, const std::shared_ptr<Told>& told,
                                          const Callback& callback) {
  return std::make_shared<dds::Reader<T>>(
      participant, topic,
      [&type, told, callback](const dds::Received<T>& sample, const dds::SampleOrigin&) {
        if (is_news<T>(*told, sample)) callback({type, sample.cdr, host::realtime_now().count()});
      },
      dds::Reliability::BestEffort);
}

template <class T>
std::shared_ptr<dds::Reader<Block<T>>> reader_of(dds::Participant& participant, const dds::Topic<Block<T>>& topic,
                                                 const log::LogType& type, const std::shared_ptr<Told>& told,
                                                 const Callback& callback) {
  return std::make_shared<dds::Reader<Block<T>>>(
      participant, topic,
      [&type, told, callback](const dds::Received<Block<T>>& block, const dds::SampleOrigin&) {
        std::vector<std::uint8_t> cdr;
        for (const T& sample : block.samples) {
          if (!is_news(*told, sample)) continue;
          wire::encode(sample, cdr);
          callback({type, cdr, host::realtime_now().count()});
        }
      },
      dds::Reliability::BestEffort);
}

/// The number at the end of a sensor's topic; nothing when it is not a number.
std::optional<std::uint32_t> number_of(const std::string& topic) {
  const std::string digits = topic.substr(topic.rfind('/') + 1);
  if (digits.empty() || digits.size() > 2 || digits.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(std::stoul(digits));
}

}  // namespace

TopicTap::TopicTap(dds::Participant& participant, const std::string& topic, const Callback& callback) {
  const auto told = std::make_shared<Told>();
  std::string known;
  const log::LogType* type = nullptr;  // of the topic; a stream comes before its blocks
  dds::topics::for_each(number_of(topic).value_or(0), [&](const auto& candidate) {
    using T = typename std::decay_t<decltype(candidate)>::Type;
    if constexpr (is_block<T>) {
      if (type == nullptr || candidate.name != catalog::block_topic(topic)) return;
      blocks_ = reader_of(participant, candidate, *type, told, callback);
    } else {
      const log::LogType* its_type = log::find_log_type(catalog::WireType<T>::name);
      if (its_type == nullptr) return;
      known += (known.empty() ? "" : ", ") + candidate.name;
      if (candidate.name != topic) return;
      type = its_type;
      const auto reader = reader_of(participant, candidate, *type, told, callback);
      matched_writers_ = [reader] { return reader->matched_writers(); };
      samples_ = reader;
    }
  });
  if (!samples_) {
    throw std::invalid_argument("no topic '" + text::shown(topic) + "' to listen to; there are " + known);
  }
}

}  // namespace inslab::client
