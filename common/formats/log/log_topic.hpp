#pragma once

#include <map>
#include <set>
#include <string>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"

namespace inslab::log {

/// The type of each channel, by its present name (wire::present_name()); empty where the log does not say.
std::map<std::uint16_t, std::string> channel_types(const mcap::McapReader& log);

/// The channels of a topic whose samples are of the named type; empty when the log has none.
std::set<std::uint16_t> channels_of(const mcap::McapReader& log, const std::string& topic, std::string_view type);

/// The same. Throws ReadError, saying what the log has, when it has none.
std::set<std::uint16_t> needed_channels_of(const mcap::McapReader& log, const std::string& topic,
                                           std::string_view type);

/// The topics of a log with their types, for messages: "inslab/truth (inslab::TruthState), ...".
std::string topics_text(const mcap::McapReader& log);

/// Calls `visit(sample, number)` with the samples of a topic in the order of their log times, `number` counting the
/// topic's messages from 1; `visit` returns false to stop. Messages that do not decode are left out and counted: the
/// count is returned. Throws ReadError, also when the log has no such topic of this type.
template <class T, class Visit>
std::uint64_t for_each_sample(const mcap::McapReader& log, const std::string& topic, Visit visit) {
  const std::set<std::uint16_t> channels = needed_channels_of(log, topic, catalog::WireType<T>::name);
  std::uint64_t number = 0;
  std::uint64_t unreadable = 0;
  T sample;
  log.for_each(
      [&](const mcap::Message& message) {
        ++number;
        if (!wire::decode(message.data, message.size, sample)) {
          ++unreadable;
          return true;
        }
        return visit(sample, number);
      },
      mcap::McapReader::Order::LogTime, channels);
  return unreadable;
}

}  // namespace inslab::log
