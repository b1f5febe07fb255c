#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "inslab/formats/mcap/mcap_format.hpp"
#include "inslab/formats/mcap/mcap_records.hpp"
#include "inslab/foundation/files/input_file.hpp"

namespace inslab::mcap {

/// Reads MCAP logs with messages in chunks (zstd or not compressed), chunk by chunk: never the whole file in memory.
///
/// A log that was closed opens through its summary. A log whose writer was killed has no footer: it is scanned, and
/// everything up to the first incomplete record is there. Anything else that is malformed throws ReadError with the
/// file, the place and what was expected.
class McapReader {
 public:
  struct Options {
    /// Largest record and largest chunk after decompression. Positions in a chunk are 32 bits wide.
    std::uint64_t max_chunk_bytes = std::uint64_t{1} << 28;
    /// Most bytes of chunks that overlap in time and are open at once for Order::LogTime.
    std::uint64_t max_open_bytes = std::uint64_t{1} << 30;
  };
  enum class Order { File, LogTime };
  /// Returns false to stop.
  using Visitor = std::function<bool(const Message&)>;

  /// Throws ReadError.
  explicit McapReader(const std::string& path);
  McapReader(const std::string& path, const Options& options);

  /// Whether the writer reached the footer.
  bool closed_properly() const { return closed_properly_; }
  /// How a log that was not closed ends, in words; empty for one that was.
  const std::string& ending() const { return ending_; }

  const std::string& profile() const { return profile_; }
  const std::string& library() const { return library_; }
  const std::map<std::uint16_t, Schema>& schemas() const { return schemas_; }
  const std::map<std::uint16_t, Channel>& channels() const { return channels_; }
  const std::vector<Metadata>& metadata() const { return metadata_; }
  const Statistics& statistics() const { return statistics_; }
  const std::string& path() const { return file_.path(); }
  std::uint64_t file_size() const { return file_.size(); }

  /// Calls `visit` with every message of `channels` (all when empty). Messages with equal log times come in file order.
  /// Throws ReadError, also for a message on a channel that the log does not declare.
  void for_each(const Visitor& visit, Order order = Order::File, const std::set<std::uint16_t>& channels = {}) const;

 private:
  struct Record {
    std::uint8_t opcode = 0;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;  ///< of the content
  };

  void read_header();
  bool open_through_summary();
  void read_summary(std::uint64_t begin, std::uint64_t end);
  void read_indexed_metadata(const MetadataIndex& index);
  void scan();
  bool scan_record(const Record& record);
  void scan_chunk(const Record& record);
  void add(Schema schema);
  void add(Channel channel);
  Record record_at(std::uint64_t offset, std::uint64_t end) const;
  std::vector<std::uint8_t> content_of(const Record& record) const;
  const Message& known(const Message& message) const;

  Options options_;
  files::InputFile file_;
  bool closed_properly_ = false;
  std::string ending_;
  std::string profile_;
  std::string library_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  std::vector<Metadata> metadata_;
  std::vector<ChunkIndex> chunks_;  ///< in file order
  Statistics statistics_;
  std::uint64_t data_begin_ = 0;
};

}  // namespace inslab::mcap
