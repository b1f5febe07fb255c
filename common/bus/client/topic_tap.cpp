#include "inslab/bus/client/topic_tap.hpp"

#include <stdexcept>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/topics.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::cli {

namespace {

using Callback = std::function<void(const TappedMessage&)>;

template <class T>
std::shared_ptr<dds::Reader<T>> reader_of(dds::Participant& participant, const dds::Topic<T>& topic,
                                          const io::LogType& type, const Callback& callback) {
  return std::make_shared<dds::Reader<T>>(
      participant, topic,
      [&type, callback](const dds::Received<T>& sample, const dds::SampleOrigin&) {
        callback({type, sample.cdr, app::realtime_now().count()});
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
  std::string known;
  dds::topics::for_each(number_of(topic).value_or(0), [&](const auto& candidate) {
    using T = typename std::decay_t<decltype(candidate)>::Type;
    const io::LogType* type = io::find_log_type(wire::WireType<T>::name);
    if (type == nullptr) return;  // blocks repeat the streams
    if (candidate.name == topic) {
      const auto reader = reader_of(participant, candidate, *type, callback);
      matched_writers_ = [reader] { return reader->matched_writers(); };
      reader_ = reader;
    }
    known += (known.empty() ? "" : ", ") + candidate.name;
  });
  if (!reader_) {
    throw std::invalid_argument("no topic '" + text::shown(topic) + "' to listen to; there are " + known);
  }
}

}  // namespace inslab::cli
