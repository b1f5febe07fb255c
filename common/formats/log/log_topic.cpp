#include "inslab/formats/log/log_topic.hpp"

#include "inslab/data/wire/idl_text.hpp"

namespace inslab::log {

std::map<std::uint16_t, std::string> channel_types(const mcap::McapReader& log) {
  std::map<std::uint16_t, std::string> types;
  for (const auto& [id, channel] : log.channels()) {
    const auto schema = log.schemas().find(channel.schema_id);
    types[id] = schema == log.schemas().end() ? "" : wire::present_name(schema->second.name);
  }
  return types;
}

std::set<std::uint16_t> channels_of(const mcap::McapReader& log, const std::string& topic, std::string_view type) {
  std::set<std::uint16_t> found;
  const auto types = channel_types(log);
  for (const auto& [id, channel] : log.channels()) {
    if (channel.topic == topic && types.at(id) == type) found.insert(id);
  }
  return found;
}

std::set<std::uint16_t> needed_channels_of(const mcap::McapReader& log, const std::string& topic,
                                           std::string_view type) {
  std::set<std::uint16_t> channels = channels_of(log, topic, type);
  if (!channels.empty()) return channels;
  throw files::ReadError(log.path() + ": has no topic " + topic + " of the type " + std::string(type) + "; it has " +
                         topics_text(log));
}

std::string topics_text(const mcap::McapReader& log) {
  std::string text;
  const auto types = channel_types(log);
  for (const auto& [id, channel] : log.channels()) {
    text += (text.empty() ? "" : ", ") + channel.topic + " (" + types.at(id) + ")";
  }
  return text.empty() ? "none" : text;
}

}  // namespace inslab::log
