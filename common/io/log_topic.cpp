#include "io/log_topic.hpp"

namespace inslab::io {

namespace {

std::string type_of(const McapReader& log, const mcap::Channel& channel) {
  const auto schema = log.schemas().find(channel.schema_id);
  return schema == log.schemas().end() ? "" : schema->second.name;
}

}  // namespace

std::set<std::uint16_t> channels_of(const McapReader& log, const std::string& topic, std::string_view type) {
  std::set<std::uint16_t> found;
  for (const auto& [id, channel] : log.channels()) {
    if (channel.topic == topic && type_of(log, channel) == type) found.insert(id);
  }
  return found;
}

std::set<std::uint16_t> needed_channels_of(const McapReader& log, const std::string& topic, std::string_view type) {
  std::set<std::uint16_t> channels = channels_of(log, topic, type);
  if (!channels.empty()) return channels;
  throw ReadError(log.path() + ": has no topic " + topic + " of the type " + std::string(type) + "; it has " +
                  topics_text(log));
}

std::string topics_text(const McapReader& log) {
  std::string text;
  for (const auto& [id, channel] : log.channels()) {
    text += (text.empty() ? "" : ", ") + channel.topic + " (" + type_of(log, channel) + ")";
  }
  return text.empty() ? "none" : text;
}

}  // namespace inslab::io
