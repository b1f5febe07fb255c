#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/formats/log/sequence_check.hpp"
#include "inslab/formats/mcap/mcap_format.hpp"

namespace inslab::log {

/// What a log holds of one topic.
struct TopicInfo {
  std::string topic;
  std::string type;  ///< such as inslab::TruthState
  std::uint64_t count = 0;
  std::uint64_t unreadable = 0;  ///< messages that are not what their type says

  /// Of types that carry a sim time.
  std::optional<std::int64_t> first_sim_time_ns;
  std::optional<std::int64_t> last_sim_time_ns;
  std::optional<double> rate_hz;  ///< (count - 1) over the time between; from two samples on

  /// Of types that carry a stream header.
  bool is_numbered = false;
  std::vector<SequenceGap> gaps;
  std::uint64_t missing = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t out_of_order = 0;
};

/// What a log holds.
struct LogInfo {
  std::string path;
  std::uint64_t file_size = 0;
  std::string library;
  bool closed_properly = false;
  std::string ending;  ///< how a log that was not closed ends
  std::uint64_t message_count = 0;
  std::uint64_t chunk_count = 0;
  std::vector<std::string> run_ids;  ///< hexadecimal, in order of appearance
  std::vector<mcap::Metadata> metadata;
  std::vector<TopicInfo> topics;  ///< by name
};

/// Reads the whole log once. A run that follows another on the same topic is numbered from 0 again. Throws ReadError.
LogInfo inspect_log(const std::string& path);

}  // namespace inslab::log
