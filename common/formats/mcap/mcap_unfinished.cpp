#include "inslab/formats/mcap/mcap_unfinished.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "inslab/formats/mcap/mcap_chunk.hpp"
#include "inslab/formats/mcap/mcap_records.hpp"
#include "inslab/foundation/files/input_file.hpp"

namespace inslab::mcap {
namespace {

constexpr std::size_t kChunkHeadAtMost = 256;  // three numbers, a CRC, the name of the compression, a number

class Scan {
 public:
  Scan(const std::string& path, std::uint64_t known_size) : file_(path), size_(std::min(file_.size(), known_size)) {}

  UnfinishedLog all() {
    std::array<std::uint8_t, 8> magic{};
    if (size_ >= magic.size()) file_.read(0, magic.data(), magic.size());
    if (magic != kMagic) throw files::ReadError(file_.path(), 0, "the magic bytes of an MCAP file");
    std::uint64_t at = magic.size();
    while (take_record(at)) {
    }
    log_.end = group_begin_.value_or(at);
    if (group_begin_) drop_open_group();
    return std::move(log_);
  }

 private:
  /// False when no whole record is left. A chunk and the indexes behind it are one group: the writer appends them at
  /// once, so a group is whole when another record follows it. Of the last one the messages are counted.
  bool take_record(std::uint64_t& at) {
    std::array<std::uint8_t, kRecordHeadSize> head{};
    const std::uint64_t left = size_ - at;
    file_.read(at, head.data(), static_cast<std::size_t>(std::min<std::uint64_t>(left, head.size())));
    files::ByteReader reader(file_.path(), at, head.data(), head.size());
    const auto opcode = reader.number<std::uint8_t>("opcode");
    const auto length = reader.number<std::uint64_t>("record length");
    const bool ends_here = left == 0 && group_begin_ && group_is_whole();
    if (ends_here || (left > 0 && opcode != kMessageIndex)) group_begin_.reset();
    if (left < kRecordHeadSize || length > left - kRecordHeadSize) return false;
    if (opcode == kDataEnd || opcode == kFooter) throw files::ReadError(file_.path(), at, "a log that was not closed");
    take(opcode, at, length);
    at += kRecordHeadSize + length;
    return true;
  }

  void take(std::uint8_t opcode, std::uint64_t at, std::uint64_t length) {
    const std::uint64_t content = at + kRecordHeadSize;
    const auto size =
        static_cast<std::size_t>(opcode == kChunk ? std::min<std::uint64_t>(length, kChunkHeadAtMost) : length);
    bytes_.resize(size);
    file_.read(content, bytes_.data(), size);
    files::ByteReader reader(file_.path(), content, bytes_.data(), size);
    if (opcode == kSchema) log_.schemas.push_back(parse_schema(reader));
    if (opcode == kChannel) log_.channels.push_back(parse_channel(reader));
    if (opcode == kMetadata) {
      log_.metadata.push_back({at, kRecordHeadSize + length, parse_metadata(reader).name});
      ++log_.statistics.metadata_count;
    }
    if (opcode == kChunk) take_chunk(at, length, reader);
    if (opcode == kMessageIndex && !log_.chunks.empty()) take_index(at, length, reader);
  }

  void take_chunk(std::uint64_t at, std::uint64_t length, files::ByteReader& reader) {
    const ChunkHead head = parse_chunk_head(reader);
    before_group_ = log_.statistics;
    group_begin_ = at;
    ChunkIndex chunk;
    chunk.start_time_ns = head.start_time_ns;
    chunk.end_time_ns = head.end_time_ns;
    chunk.offset = at;
    chunk.length = kRecordHeadSize + length;
    chunk.compressed_size = head.compressed_size;
    chunk.uncompressed_size = head.uncompressed_size;
    Statistics& s = log_.statistics;
    s.message_start_time_ns =
        s.chunk_count == 0 ? head.start_time_ns : std::min(s.message_start_time_ns, head.start_time_ns);
    s.message_end_time_ns = std::max(s.message_end_time_ns, head.end_time_ns);
    ++s.chunk_count;
    log_.chunks.push_back(chunk);
  }

  void take_index(std::uint64_t at, std::uint64_t length, files::ByteReader& reader) {
    const auto channel = reader.number<std::uint16_t>("channel id");
    const std::uint64_t messages = reader.block("message index").left() / kIndexEntrySize;
    ChunkIndex& chunk = log_.chunks.back();
    chunk.message_index_offsets[channel] = at;
    chunk.message_index_length += kRecordHeadSize + length;
    log_.statistics.message_count += messages;
    log_.statistics.channel_message_counts[channel] += messages;
  }

  bool group_is_whole() const {
    constexpr std::uint64_t kAtMost = 0xffffffff;
    const Chunk chunk(file_, log_.chunks.back().offset, log_.chunks.back().length, kAtMost);
    return chunk.messages({}).size() == log_.statistics.message_count - before_group_.message_count;
  }

  void drop_open_group() {
    log_.chunks.pop_back();
    log_.statistics = before_group_;
  }

  files::InputFile file_;
  std::uint64_t size_;  ///< of what is looked at
  UnfinishedLog log_;
  std::optional<std::uint64_t> group_begin_;  ///< of the group that may not be whole
  Statistics before_group_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

UnfinishedLog read_unfinished(const std::string& path, std::uint64_t known_size) {
  return Scan(path, known_size).all();
}

}  // namespace inslab::mcap
