#include "inslab/formats/mcap/mcap_reader.hpp"

#include <zlib.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "inslab/formats/mcap/mcap_chunk.hpp"
#include "inslab/formats/mcap/mcap_merge.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"

namespace inslab::mcap {
namespace {

constexpr std::uint64_t kEndSize = kRecordHeadSize + kFooterSize + kMagic.size();

bool holds(const ChunkIndex& chunk, const std::set<std::uint16_t>& channels) {
  if (channels.empty() || chunk.message_index_offsets.empty()) return true;
  return std::any_of(channels.begin(), channels.end(),
                     [&](std::uint16_t id) { return chunk.message_index_offsets.count(id) > 0; });
}

static_assert(McapReader::Options{}.max_chunk_bytes == files::kMaxLogRecordBytes, "one limit");
static_assert(McapReader::Options{}.max_open_bytes == files::kMaxOpenLogBytes, "one limit");

}  // namespace

McapReader::McapReader(const std::string& path) : McapReader(path, Options()) {}

McapReader::McapReader(const std::string& path, const Options& options) : options_(options), file_(path) {
  options_.max_chunk_bytes = std::min(options_.max_chunk_bytes, std::uint64_t{0xffffffff});
  read_header();
  if (!open_through_summary()) scan();
}

void McapReader::read_header() {
  std::array<std::uint8_t, 8> magic{};
  if (file_.size() >= magic.size()) file_.read(0, magic.data(), magic.size());
  if (magic != kMagic) throw files::ReadError(path(), 0, "the magic bytes of an MCAP file");
  const Record record = record_at(magic.size(), file_.size());
  if (record.opcode != kHeader) throw files::ReadError(path(), magic.size(), "a whole header record");
  const std::vector<std::uint8_t> content = content_of(record);
  files::ByteReader reader(path(), record.offset + kRecordHeadSize, content.data(), content.size());
  profile_ = reader.text("profile");
  library_ = reader.text("library");
  data_begin_ = record.offset + kRecordHeadSize + record.length;
}

/// The record whose head lies at `offset`; opcode 0 when it does not end before `end`.
McapReader::Record McapReader::record_at(std::uint64_t offset, std::uint64_t end) const {
  if (offset > end || end - offset < kRecordHeadSize) return {};
  std::uint8_t bytes[kRecordHeadSize];
  file_.read(offset, bytes, sizeof(bytes));
  files::ByteReader reader(path(), offset, bytes, sizeof(bytes));
  Record record;
  record.opcode = reader.number<std::uint8_t>("opcode");
  record.offset = offset;
  record.length = reader.number<std::uint64_t>("record length");
  if (record.length > end - offset - kRecordHeadSize) return {};
  return record;
}

std::vector<std::uint8_t> McapReader::content_of(const Record& record) const {
  if (record.length > options_.max_chunk_bytes) {
    throw files::ReadError(path(), record.offset + 1,
                           "a record of at most " + std::to_string(options_.max_chunk_bytes) + " bytes");
  }
  std::vector<std::uint8_t> content(record.length);
  file_.read(record.offset + kRecordHeadSize, content.data(), content.size());
  return content;
}

/// False when there is no footer, or no summary behind it that would do.
bool McapReader::open_through_summary() {
  if (file_.size() < data_begin_ + kEndSize) return false;
  std::array<std::uint8_t, 8> magic{};
  file_.read(file_.size() - magic.size(), magic.data(), magic.size());
  if (magic != kMagic) return false;
  const std::uint64_t footer_offset = file_.size() - kEndSize;
  const Record record = record_at(footer_offset, file_.size() - magic.size());
  if (record.opcode != kFooter || record.length != kFooterSize) {
    throw files::ReadError(path(), footer_offset, "a footer before the magic bytes at the end");
  }
  const std::vector<std::uint8_t> content = content_of(record);
  const Footer footer =
      parse_footer(files::ByteReader(path(), footer_offset + kRecordHeadSize, content.data(), content.size()));
  closed_properly_ = true;
  if (footer.summary_start == 0) return false;
  if (footer.summary_start < data_begin_ || footer.summary_start > footer_offset) {
    throw files::ReadError(path(), footer_offset + kRecordHeadSize,
                           "the place of the summary between header and footer");
  }
  const std::uint64_t crc_end = file_.size() - magic.size() - 4;
  std::vector<std::uint8_t> piece(std::size_t{1} << 16);
  std::uint32_t crc = 0;
  for (std::uint64_t at = footer.summary_start; at < crc_end && footer.summary_crc != 0; at += piece.size()) {
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(piece.size(), crc_end - at));
    file_.read(at, piece.data(), size);
    crc = static_cast<std::uint32_t>(crc32_z(crc, piece.data(), size));
  }
  if (crc != footer.summary_crc)
    throw files::ReadError(path(), footer.summary_start, "a summary with the footer's CRC");
  read_summary(footer.summary_start, footer_offset);
  const bool usable = chunks_.size() == statistics_.chunk_count && statistics_.message_count > 0;
  if (!usable) {
    // Summaries are optional in every part; ours are whole, so this is a foreign log or an empty one.
    schemas_.clear();
    channels_.clear();
    metadata_.clear();
    chunks_.clear();
    statistics_ = {};
  }
  return usable;
}

void McapReader::read_summary(std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t at = begin; at < end;) {
    const Record record = record_at(at, end);
    if (record.opcode == 0) throw files::ReadError(path(), at, "a record of the summary that ends before the footer");
    const std::vector<std::uint8_t> content = content_of(record);
    const files::ByteReader reader(path(), at + kRecordHeadSize, content.data(), content.size());
    if (record.opcode == kSchema) add(parse_schema(reader));
    if (record.opcode == kChannel) add(parse_channel(reader));
    if (record.opcode == kStatistics) statistics_ = parse_statistics(reader);
    if (record.opcode == kChunkIndex) chunks_.push_back(parse_chunk_index(reader));
    if (record.opcode == kMetadataIndex) read_indexed_metadata(parse_metadata_index(reader));
    at += kRecordHeadSize + record.length;
  }
  std::sort(chunks_.begin(), chunks_.end(), [](const auto& a, const auto& b) { return a.offset < b.offset; });
}

void McapReader::read_indexed_metadata(const MetadataIndex& index) {
  const Record record = record_at(index.offset, file_.size());
  if (record.opcode != kMetadata) throw files::ReadError(path(), index.offset, "the metadata record " + index.name);
  const std::vector<std::uint8_t> content = content_of(record);
  metadata_.push_back(
      parse_metadata(files::ByteReader(path(), index.offset + kRecordHeadSize, content.data(), content.size())));
}

void McapReader::scan() {
  for (std::uint64_t at = data_begin_;;) {
    const Record record = record_at(at, file_.size());
    if (record.opcode == 0 && closed_properly_) throw files::ReadError(path(), at, "a whole record before the footer");
    if (record.opcode == 0) {
      ending_ = at == file_.size() ? "no footer: the writer did not close the log"
                                   : "no footer: the file ends inside the record at byte " + std::to_string(at);
      return;
    }
    if (!scan_record(record)) {
      if (!closed_properly_) ending_ = "no footer: the file ends inside the summary";
      return;
    }
    at += kRecordHeadSize + record.length;
  }
}

/// False at the end of the data section.
bool McapReader::scan_record(const Record& record) {
  if (record.opcode == kDataEnd || record.opcode == kFooter) return false;
  if (record.opcode == kMessage) throw files::ReadError(path(), record.offset, "messages inside chunks only");
  if (record.opcode == kChunk) {
    scan_chunk(record);
    return true;
  }
  const bool wanted = record.opcode == kSchema || record.opcode == kChannel || record.opcode == kMetadata;
  if (!wanted) return true;
  const std::vector<std::uint8_t> content = content_of(record);
  const files::ByteReader reader(path(), record.offset + kRecordHeadSize, content.data(), content.size());
  if (record.opcode == kSchema) add(parse_schema(reader));
  if (record.opcode == kChannel) add(parse_channel(reader));
  if (record.opcode == kMetadata) {
    metadata_.push_back(parse_metadata(reader));
    ++statistics_.metadata_count;
  }
  return true;
}

void McapReader::scan_chunk(const Record& record) {
  const Chunk chunk(file_, record.offset, kRecordHeadSize + record.length, options_.max_chunk_bytes);
  ChunkIndex index;
  index.start_time_ns = chunk.head().start_time_ns;
  index.end_time_ns = chunk.head().end_time_ns;
  index.offset = record.offset;
  index.length = kRecordHeadSize + record.length;
  index.compressed_size = chunk.head().compressed_size;
  index.uncompressed_size = chunk.head().uncompressed_size;
  chunk.for_each_record([&](std::uint8_t opcode, files::ByteReader content) {
    if (opcode == kSchema) add(parse_schema(content));
    if (opcode == kChannel) add(parse_channel(content));
    if (opcode != kMessage) return;
    const Message message = parse_message(content);
    Statistics& s = statistics_;
    s.message_start_time_ns =
        s.message_count == 0 ? message.log_time_ns : std::min(s.message_start_time_ns, message.log_time_ns);
    s.message_end_time_ns = std::max(s.message_end_time_ns, message.log_time_ns);
    ++s.message_count;
    ++s.channel_message_counts[message.channel_id];
    index.message_index_offsets[message.channel_id] = 0;  // known to be there; where does not matter to us
  });
  ++statistics_.chunk_count;
  chunks_.push_back(std::move(index));
}

void McapReader::add(Schema schema) {
  const std::uint16_t id = schema.id;
  schemas_.emplace(id, std::move(schema));
}

void McapReader::add(Channel channel) {
  const std::uint16_t id = channel.id;
  channels_.emplace(id, std::move(channel));
}

const Message& McapReader::known(const Message& message) const {
  if (channels_.count(message.channel_id) == 0) {
    throw files::ReadError(path() + ": a message belongs to channel " + std::to_string(message.channel_id) +
                           ", which the log does not declare");
  }
  return message;
}

void McapReader::for_each(const Visitor& visit, Order order, const std::set<std::uint16_t>& channels) const {
  std::vector<ChunkIndex> chunks;
  std::copy_if(chunks_.begin(), chunks_.end(), std::back_inserter(chunks),
               [&](const ChunkIndex& chunk) { return holds(chunk, channels); });
  if (order == Order::LogTime) {
    LogTimeMerge merge(file_, std::move(chunks), channels, options_.max_chunk_bytes, options_.max_open_bytes);
    for (Message message; merge.next(message);) {
      if (!visit(known(message))) return;
    }
    return;
  }
  for (const ChunkIndex& index : chunks) {
    const Chunk chunk(file_, index.offset, index.length, options_.max_chunk_bytes);
    for (const Chunk::Entry& entry : chunk.messages(channels)) {
      if (!visit(known(chunk.message_at(entry.position)))) return;
    }
  }
}

}  // namespace inslab::mcap
