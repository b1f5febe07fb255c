#include "inslab/formats/mcap/mcap_chunk.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>

#include "inslab/foundation/files/byte_writer.hpp"

namespace inslab::mcap {
namespace {

files::Bytes decompress(const std::string& place, const std::uint8_t* data, std::size_t size,
                        std::size_t expected_size) {
  // What the frame says of itself is asked first, so that a lying chunk allocates nothing.
  const unsigned long long content = ZSTD_getFrameContentSize(data, size);
  if (content == ZSTD_CONTENTSIZE_ERROR) throw files::ReadError(place + ": expected a zstd frame");
  if (content != ZSTD_CONTENTSIZE_UNKNOWN && content != expected_size) {
    throw files::ReadError(place + ": expected a zstd frame of " + std::to_string(expected_size) + " bytes, found " +
                           std::to_string(content));
  }
  files::Bytes out(expected_size);
  const std::size_t written = ZSTD_decompress(out.data(), out.size(), data, size);
  if (ZSTD_isError(written) != 0) throw files::ReadError(place + ": zstd: " + ZSTD_getErrorName(written));
  if (written != expected_size) {
    throw files::ReadError(place + ": expected " + std::to_string(expected_size) +
                           " bytes after decompression, found " + std::to_string(written));
  }
  return out;
}

}  // namespace

Chunk::Chunk(const files::InputFile& file, std::uint64_t offset, std::uint64_t length, std::uint64_t max_bytes)
    : offset_(offset), place_(file.path() + ": chunk at byte " + std::to_string(offset)) {
  if (length < kRecordHeadSize || length > max_bytes) {
    throw files::ReadError(place_ + ": expected a length up to " + std::to_string(max_bytes) + ", found " +
                           std::to_string(length));
  }
  if (offset > file.size() || length > file.size() - offset)
    throw files::ReadError(place_ + ": lies beyond the end of the file");
  files::Bytes record(length);
  file.read(offset, record.data(), record.size());
  files::ByteReader reader(file.path(), offset, record.data(), record.size());
  if (reader.number<std::uint8_t>("opcode") != kChunk) throw files::ReadError(file.path(), offset, "a chunk");
  if (reader.number<std::uint64_t>("record length") != length - kRecordHeadSize) {
    throw files::ReadError(file.path(), offset + 1,
                           "a chunk of " + std::to_string(length - kRecordHeadSize) + " bytes");
  }
  head_ = parse_chunk_head(reader);
  const std::uint8_t* data = reader.take(head_.compressed_size, "compressed records");
  if (head_.uncompressed_size > max_bytes) {
    throw files::ReadError(place_ + ": expected at most " + std::to_string(max_bytes) + " bytes, found " +
                           std::to_string(head_.uncompressed_size));
  }
  if (head_.compression == "zstd") {
    records_ = decompress(place_, data, head_.compressed_size, head_.uncompressed_size);
  } else if (head_.compression.empty()) {
    records_.assign(data, data + head_.compressed_size);
  } else {
    throw files::ReadError(place_ + ": expected compression zstd or none, found " + head_.compression);
  }
  const auto crc = static_cast<std::uint32_t>(crc32_z(0, records_.data(), records_.size()));
  if (head_.uncompressed_crc != 0 && head_.uncompressed_crc != crc) {
    throw files::ReadError(place_ + ": expected CRC " + std::to_string(head_.uncompressed_crc) + ", found " +
                           std::to_string(crc));
  }
}

void Chunk::for_each_record(const std::function<void(std::uint8_t, files::ByteReader)>& visit) const {
  files::ByteReader reader(place_, 0, records_.data(), records_.size());
  while (reader.left() > 0) {
    const auto opcode = reader.number<std::uint8_t>("opcode");
    const auto length = reader.number<std::uint64_t>("record length");
    const std::uint64_t offset = reader.file_offset();
    const std::uint8_t* content = reader.take(length, "record");
    visit(opcode, files::ByteReader(place_, offset, content, static_cast<std::size_t>(length)));
  }
}

Message Chunk::message_at(std::size_t position) const {
  files::ByteReader reader(place_, position, records_.data() + position, records_.size() - position);
  reader.number<std::uint8_t>("opcode");
  const auto length = reader.number<std::uint64_t>("record length");
  const std::uint64_t offset = reader.file_offset();
  return parse_message(
      files::ByteReader(place_, offset, reader.take(length, "message"), static_cast<std::size_t>(length)));
}

std::vector<Chunk::Entry> Chunk::messages(const std::set<std::uint16_t>& channels) const {
  std::vector<Entry> entries;
  for_each_record([&](std::uint8_t opcode, files::ByteReader content) {
    if (opcode != kMessage) return;
    const auto position = static_cast<std::uint32_t>(content.file_offset() - kRecordHeadSize);
    const Message message = parse_message(content);
    if (message.log_time_ns < head_.start_time_ns || message.log_time_ns > head_.end_time_ns) {
      throw files::ReadError(place_, position, "a log time inside the chunk's");
    }
    if (channels.empty() || channels.count(message.channel_id) > 0) entries.push_back({message.log_time_ns, position});
  });
  return entries;
}

}  // namespace inslab::mcap
