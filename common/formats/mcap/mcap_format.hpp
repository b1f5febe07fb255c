#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// The MCAP container (https://mcap.dev/spec, version 0): what a log is made of. A log is
/// magic, Header, data section, DataEnd, summary section, Footer, magic; every record is an opcode (1 byte), a length
/// (8 bytes) and that many bytes; all numbers are little endian.
namespace inslab::mcap {

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kRecordHeadSize = 9;
inline constexpr std::size_t kMessageHeadSize = 22;  // channel, sequence, log time, publish time
inline constexpr std::size_t kFooterSize = 20;
inline constexpr std::size_t kIndexEntrySize = 16;  // of a MessageIndex: log time, offset

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

using StringMap = std::map<std::string, std::string>;

/// How the messages of a channel are described: for us the self-contained IDL text ("omgidl") of one type.
struct Schema {
  std::uint16_t id = 0;  ///< never 0
  std::string name;      ///< such as inslab::TruthState
  std::string encoding;  ///< "omgidl"
  std::string text;
};

/// One topic of the log.
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;  ///< "cdr"
  StringMap metadata;
};

/// One message; `data` is valid until the reader moves on.
struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// Named strings about the whole log.
struct Metadata {
  std::string name;
  StringMap values;
};

/// Counts over the whole log.
struct Statistics {
  std::uint64_t message_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint64_t message_start_time_ns = 0;  ///< smallest log time; 0 without messages
  std::uint64_t message_end_time_ns = 0;    ///< largest log time
  std::map<std::uint16_t, std::uint64_t> channel_message_counts;
};

/// Where a chunk lies and which log times it holds.
struct ChunkIndex {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t offset = 0;  ///< of the Chunk record in the file
  std::uint64_t length = 0;  ///< of the Chunk record, its head included
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;
  std::uint64_t message_index_length = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

/// Where a Metadata record lies.
struct MetadataIndex {
  std::uint64_t offset = 0;
  std::uint64_t length = 0;
  std::string name;
};

}  // namespace inslab::mcap
