#include "inslab/formats/log/log_walk.hpp"

#include "inslab/formats/log/log_topic.hpp"

namespace inslab::log {

void LogWalk::go() const {
  struct Channel {
    const std::string* topic = nullptr;
    const Takers* takers = nullptr;
    std::vector<const std::function<void()>*> told;
  };
  std::map<std::uint16_t, Channel> channels;
  for (const auto& [id, type] : channel_types(log_)) {
    Channel& channel = channels[id];
    channel.topic = &log_.channels().at(id).topic;
    const auto takers = by_type_.find(type);
    if (takers != by_type_.end()) channel.takers = takers->second.get();
    const auto told = by_topic_.equal_range(*channel.topic);
    for (auto it = told.first; it != told.second; ++it) channel.told.push_back(&it->second);
  }
  log_.for_each([&](const mcap::Message& message) {
    const Channel& channel = channels.at(message.channel_id);
    for (const std::function<void()>* tell : channel.told) (*tell)();
    if (channel.takers != nullptr) {
      channel.takers->give(message, {*channel.topic, static_cast<std::int64_t>(message.log_time_ns)});
    }
    return true;
  });
}

}  // namespace inslab::log
