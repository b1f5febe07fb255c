#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "inslab/formats/mcap/mcap_format.hpp"
#include "inslab/formats/mcap/mcap_unfinished.hpp"
#include "inslab/foundation/files/output_file.hpp"

namespace inslab::mcap {

/// Writes an MCAP log: messages collect in a chunk, which is compressed with zstd and appended when it is full.
///
/// What a killed process leaves is a whole log up to the last flush() or full chunk, without footer; McapReader and
/// other readers open it. After an error of the disk the log ends with the last whole chunk; see WriteError below.
class McapWriter {
 public:
  struct Options {
    std::string profile;                ///< MCAP's name for agreements on topics and types; ours has none
    std::string library = "inslab";     ///< who wrote it
    std::size_t chunk_bytes = 1 << 20;  ///< before compression; a larger message gets a chunk of its own
    int compression_level = kFastLevel;
    files::OutputFile::Kind kind =
        files::OutputFile::Kind::Log;  ///< Result: nothing is there under its name before close()
  };

  /// The zstd level for logs written at full speed. Where every low bit is noise, level -1 leaves 64 % of the payload's
  /// bytes for 0.9 us a message of 347 bytes, level 1 leaves 62.5 % for 1.5 us, level -5 67.5 % for 0.8 us (one core of
  /// a 2 GHz Xeon, encoding and indexes included; tests/bench/log_bench.cpp).
  static constexpr int kFastLevel = -1;

  /// Throws WriteError.
  explicit McapWriter(const std::string& path);
  McapWriter(const std::string& path, Options options);

  /// Goes on with what a killed writer left at `path`; see mcap::read_unfinished(). Types and topics that are added
  /// again keep their ids. Throws WriteError.
  McapWriter(const std::string& path, Options options, UnfinishedLog unfinished);

  /// Closes; an error is lost here, so call close() first.
  ~McapWriter();
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Adds a type, unless it is there already; the id is for add_channel(). Throws WriteError, std::length_error above
  /// 65535 types.
  std::uint16_t add_schema(std::string_view name, std::string_view encoding, std::string_view text);

  /// Adds a topic of the type `schema_id` (0: none), unless a log that goes on has it; the id is for write(). Throws
  /// WriteError, std::out_of_range for a schema that was not added, std::length_error above 65535 topics.
  std::uint16_t add_channel(std::uint16_t schema_id, std::string_view topic, std::string_view message_encoding,
                            const StringMap& metadata = {});

  /// Adds one message. Throws WriteError, once: neither the open chunk nor this message is in the log then, and it
  /// takes no more (failed() is true): calls do nothing but count. Throws std::out_of_range for a channel that was not
  /// added.
  void write(std::uint16_t channel_id, std::uint32_t sequence, std::uint64_t log_time_ns, std::uint64_t publish_time_ns,
             const std::uint8_t* data, std::size_t size);

  /// As write(), for a payload that the caller encodes in place: `size` bytes, to be filled before the next call.
  std::uint8_t* reserve(std::uint16_t channel_id, std::uint32_t sequence, std::uint64_t log_time_ns,
                        std::uint64_t publish_time_ns, std::size_t size);

  /// Adds named strings about the whole log, at once. Throws WriteError.
  void metadata(std::string_view name, const StringMap& values);

  /// Closes the open chunk and hands it to the kernel. Throws WriteError.
  void flush();

  /// Writes the summary and closes the file; further calls do nothing. After a WriteError it still tries to end the log
  /// properly, with a metadata record "write_error" (reason, messages_lost), and says nothing if that fails too. Throws
  /// WriteError.
  void close();

  bool failed() const { return !failure_.empty(); }
  std::uint64_t messages_lost() const { return messages_lost_; }
  std::uint64_t file_size() const { return file_.size(); }

 private:
  struct Compressor;
  struct OpenChannel {
    Channel channel;
    std::uint64_t message_count = 0;
    std::vector<std::uint8_t> index;  ///< of the open chunk: pairs of log time and offset
  };

  std::uint8_t* place_message(OpenChannel& channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                              std::uint64_t publish_time_ns, std::size_t size);
  void close_chunk();
  void add_message_indexes(ChunkIndex& chunk, std::size_t chunk_record_size);
  void append(const std::vector<std::uint8_t>& bytes);
  void count_chunk(ChunkIndex chunk);
  void write_metadata(std::string_view name, const StringMap& values);
  void write_end();
  void write_summary(std::vector<std::uint8_t>& out) const;

  Options options_;
  files::OutputFile file_;
  std::unique_ptr<Compressor> compressor_;
  std::vector<Schema> schemas_;
  std::vector<OpenChannel> channels_;
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  std::vector<std::uint8_t> chunk_;  ///< the open chunk, not compressed
  std::size_t chunk_size_ = 0;       ///< of chunk_, bytes in use
  std::uint64_t chunk_messages_ = 0;
  ChunkIndex open_;                   ///< the times of the open chunk
  std::vector<std::uint8_t> record_;  ///< what is appended next
  Statistics statistics_;
  std::uint32_t data_crc_ = 0;
  bool data_crc_known_ = true;  ///< of a log that goes on it would take reading the whole file
  std::uint64_t messages_lost_ = 0;
  std::string failure_;
  bool closed_ = false;
};

}  // namespace inslab::mcap
