#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "inslab/formats/tables/columns.hpp"

namespace inslab::log {

/// What a sample says of itself.
struct SampleStamp {
  std::optional<RunId> run_id;
  std::optional<std::uint64_t> sequence_number;  ///< of types that carry a stream header
  std::optional<std::int64_t> sim_time_ns;
};

/// One type of message that a log may hold, by the name of its schema.
struct LogType {
  std::string_view name;  ///< such as inslab::v5::TruthState
  std::vector<tables::Column> columns;

  /// Decodes a CDR payload; both return false when it is not a sample of this type.
  bool (*row)(const std::uint8_t* data, std::size_t size, tables::Row& row) = nullptr;
  bool (*stamp)(const std::uint8_t* data, std::size_t size, SampleStamp& stamp) = nullptr;
};

/// Every type that travels as a topic.
const std::vector<LogType>& log_types();

/// Null for a schema that is not ours; one of an earlier version of the wire types is found by its name there.
const LogType* find_log_type(std::string_view schema_name);

}  // namespace inslab::log
