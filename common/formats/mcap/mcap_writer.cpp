#include "inslab/formats/mcap/mcap_writer.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "inslab/formats/mcap/mcap_put.hpp"
#include "inslab/foundation/files/byte_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"

namespace inslab::mcap {
namespace {

// Chunk: three 8-byte numbers, CRC, compression, length of the records.
constexpr std::size_t kChunkHeadSize = kRecordHeadSize + 3 * 8 + 4 + 4 + kCompression.size() + 8;

std::uint32_t crc(std::uint32_t before, const std::uint8_t* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(before, data, size));
}

}  // namespace

struct McapWriter::Compressor {
  explicit Compressor(int level) : context(ZSTD_createCCtx()) {
    if (context == nullptr) throw std::bad_alloc();
    if (ZSTD_isError(ZSTD_CCtx_setParameter(context, ZSTD_c_compressionLevel, level)) != 0) {
      ZSTD_freeCCtx(context);
      throw std::invalid_argument("zstd has no compression level " + std::to_string(level));
    }
  }
  ~Compressor() { ZSTD_freeCCtx(context); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  ZSTD_CCtx* context;
};

McapWriter::McapWriter(const std::string& path) : McapWriter(path, Options()) {}

McapWriter::McapWriter(const std::string& path, Options options)
    : options_(std::move(options)),
      file_(path, options_.kind),
      compressor_(new Compressor(options_.compression_level)) {
  chunk_.resize(options_.chunk_bytes);
  record_.clear();
  put_header(options_.profile, options_.library, record_);
  append(record_);
}

McapWriter::McapWriter(const std::string& path, Options options, UnfinishedLog unfinished)
    : options_(std::move(options)),
      file_(path, unfinished.end),
      compressor_(new Compressor(options_.compression_level)),
      schemas_(std::move(unfinished.schemas)),
      chunks_(std::move(unfinished.chunks)),
      metadata_(std::move(unfinished.metadata)),
      statistics_(std::move(unfinished.statistics)),
      data_crc_known_(false) {
  for (Channel& channel : unfinished.channels) channels_.push_back({std::move(channel), 0, {}});
  chunk_.resize(options_.chunk_bytes);
}

McapWriter::~McapWriter() {
  if (options_.kind == files::OutputFile::Kind::Result) return;  // half a result is none
  try {
    close();
  } catch (const std::exception&) {
    // Promised in the header: whoever wants to know calls close().
  }
}

std::uint16_t McapWriter::add_schema(std::string_view name, std::string_view encoding, std::string_view text) {
  const auto same = std::find_if(schemas_.begin(), schemas_.end(), [&](const Schema& schema) {
    return schema.name == name && schema.encoding == encoding && schema.text == text;
  });
  if (same != schemas_.end()) return same->id;
  if (schemas_.size() >= 65535) throw std::length_error(file_.path() + ": more than 65535 types");
  const auto id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back({id, std::string(name), std::string(encoding), std::string(text)});
  record_.clear();
  put_schema(schemas_.back(), record_);
  append(record_);
  return id;
}

std::uint16_t McapWriter::add_channel(std::uint16_t schema_id, std::string_view topic,
                                      std::string_view message_encoding, const StringMap& metadata) {
  if (schema_id > schemas_.size()) throw std::out_of_range(file_.path() + ": no such type for " + std::string(topic));
  for (const OpenChannel& known : channels_) {
    if (!data_crc_known_ && known.channel.topic == topic && known.channel.schema_id == schema_id)
      return known.channel.id;
  }
  if (channels_.size() >= 65535) throw std::length_error(file_.path() + ": more than 65535 topics");
  const auto id = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back({{id, schema_id, std::string(topic), std::string(message_encoding), metadata}, 0, {}});
  record_.clear();
  put_channel(channels_.back().channel, record_);
  append(record_);
  return id;
}

void McapWriter::write(std::uint16_t channel_id, std::uint32_t sequence, std::uint64_t log_time_ns,
                       std::uint64_t publish_time_ns, const std::uint8_t* data, std::size_t size) {
  std::uint8_t* place = reserve(channel_id, sequence, log_time_ns, publish_time_ns, size);
  if (size > 0) std::memcpy(place, data, size);
}

std::uint8_t* McapWriter::reserve(std::uint16_t channel_id, std::uint32_t sequence, std::uint64_t log_time_ns,
                                  std::uint64_t publish_time_ns, std::size_t size) {
  OpenChannel& channel = channels_.at(channel_id);
  const std::size_t record_size = kRecordHeadSize + kMessageHeadSize + size;
  if (chunk_size_ > 0 && chunk_size_ + record_size > options_.chunk_bytes) {
    try {
      flush();
    } catch (const files::WriteError&) {
      ++messages_lost_;
      throw;
    }
  }
  return place_message(channel, sequence, log_time_ns, publish_time_ns, size);
}

std::uint8_t* McapWriter::place_message(OpenChannel& channel, std::uint32_t sequence, std::uint64_t log_time_ns,
                                        std::uint64_t publish_time_ns, std::size_t size) {
  const std::size_t content_size = kMessageHeadSize + size;
  const std::size_t end = chunk_size_ + kRecordHeadSize + content_size;
  if (end > chunk_.size()) chunk_.resize(end);
  std::uint8_t* at = chunk_.data() + chunk_size_;
  if (closed_ || failed()) {
    // The log takes no more; the caller gets a place to write into all the same.
    ++messages_lost_;
    return at + kRecordHeadSize + kMessageHeadSize;
  }
  const std::uint64_t offset = chunk_size_;
  *at = kMessage;
  files::ByteWriter::store(at + 1, static_cast<std::uint64_t>(content_size));
  files::ByteWriter::store(at + 9, channel.channel.id);
  files::ByteWriter::store(at + 11, sequence);
  files::ByteWriter::store(at + 15, log_time_ns);
  files::ByteWriter::store(at + 23, publish_time_ns);
  chunk_size_ = end;

  files::ByteWriter index(channel.index);
  index.number(log_time_ns);
  index.number(offset);
  open_.start_time_ns = chunk_messages_ == 0 ? log_time_ns : std::min(open_.start_time_ns, log_time_ns);
  open_.end_time_ns = chunk_messages_ == 0 ? log_time_ns : std::max(open_.end_time_ns, log_time_ns);
  ++chunk_messages_;
  return at + kRecordHeadSize + kMessageHeadSize;
}

void McapWriter::metadata(std::string_view name, const StringMap& values) {
  if (closed_ || failed()) return;
  write_metadata(name, values);
}

void McapWriter::write_metadata(std::string_view name, const StringMap& values) {
  record_.clear();
  files::ByteWriter writer(record_);
  const std::size_t at = writer.begin_record(kMetadata);
  writer.text(name);
  writer.text_map(values);
  writer.end_record(at);
  const MetadataIndex index{file_.size(), record_.size(), std::string(name)};
  append(record_);
  if (failed()) return;
  metadata_.push_back(index);
  ++statistics_.metadata_count;
}

void McapWriter::flush() {
  if (closed_ || failed() || chunk_messages_ == 0) return;
  close_chunk();
}

void McapWriter::close_chunk() {
  ChunkIndex chunk = open_;
  chunk.offset = file_.size();
  chunk.uncompressed_size = chunk_size_;
  record_.resize(kChunkHeadSize + ZSTD_compressBound(chunk_size_));
  chunk.compressed_size = ZSTD_compress2(compressor_->context, record_.data() + kChunkHeadSize,
                                         record_.size() - kChunkHeadSize, chunk_.data(), chunk_size_);
  if (ZSTD_isError(chunk.compressed_size) != 0) {
    throw std::runtime_error(file_.path() + ": zstd: " + ZSTD_getErrorName(chunk.compressed_size));
  }
  chunk.length = kChunkHeadSize + chunk.compressed_size;
  record_.resize(chunk.length);

  files::Bytes head;
  head.reserve(kChunkHeadSize);
  files::ByteWriter writer(head);
  writer.begin_record(kChunk);
  writer.number(chunk.start_time_ns);
  writer.number(chunk.end_time_ns);
  writer.number(chunk.uncompressed_size);
  writer.number(crc(0, chunk_.data(), chunk_size_));
  writer.text(kCompression);
  writer.number(chunk.compressed_size);
  files::ByteWriter::store(head.data() + 1, static_cast<std::uint64_t>(chunk.length - kRecordHeadSize));
  std::copy(head.begin(), head.end(), record_.begin());

  add_message_indexes(chunk, chunk.length);
  chunk_size_ = 0;
  append(record_);
  count_chunk(std::move(chunk));
}

void McapWriter::add_message_indexes(ChunkIndex& chunk, std::size_t chunk_record_size) {
  files::ByteWriter writer(record_);
  for (OpenChannel& channel : channels_) {
    if (channel.index.empty()) continue;
    chunk.message_index_offsets[channel.channel.id] = chunk.offset + record_.size();
    const std::size_t at = writer.begin_record(kMessageIndex);
    writer.number(channel.channel.id);
    const std::size_t entries = writer.begin_block();
    record_.insert(record_.end(), channel.index.begin(), channel.index.end());
    writer.end_block(entries);
    writer.end_record(at);
  }
  chunk.message_index_length = record_.size() - chunk_record_size;
}

void McapWriter::count_chunk(ChunkIndex chunk) {
  const bool first = statistics_.message_count == 0;
  statistics_.message_start_time_ns =
      first ? chunk.start_time_ns : std::min(statistics_.message_start_time_ns, chunk.start_time_ns);
  statistics_.message_end_time_ns = std::max(statistics_.message_end_time_ns, chunk.end_time_ns);
  statistics_.message_count += chunk_messages_;
  ++statistics_.chunk_count;
  for (OpenChannel& channel : channels_) {
    const std::size_t count = channel.index.size() / kIndexEntrySize;
    if (count > 0) statistics_.channel_message_counts[channel.channel.id] += count;
    channel.index.clear();
  }
  chunk_messages_ = 0;
  chunks_.push_back(std::move(chunk));
}

void McapWriter::append(const files::Bytes& bytes) {
  if (closed_ || failed()) return;
  try {
    file_.append(bytes.data(), bytes.size());
  } catch (const files::WriteError& error) {
    failure_ = error.what();
    messages_lost_ += chunk_messages_;
    throw;
  }
  data_crc_ = crc(data_crc_, bytes.data(), bytes.size());
}

void McapWriter::close() {
  if (closed_) return;
  if (!failed()) {
    flush();
    write_end();
    closed_ = true;
    file_.close();
    return;
  }
  const StringMap reason{{"reason", failure_}, {"messages_lost", std::to_string(messages_lost_)}};
  failure_.clear();
  try {
    write_metadata("write_error", reason);
    write_end();
  } catch (const files::WriteError&) {
    // Already told; the log stays readable up to the last whole record.
  }
  failure_ = reason.at("reason");
  closed_ = true;
  try {
    file_.close();
  } catch (const files::WriteError&) {
  }
}

void McapWriter::write_end() {
  files::Bytes end;
  files::ByteWriter writer(end);
  const std::size_t data_end = writer.begin_record(kDataEnd);
  writer.number(data_crc_known_ ? data_crc_ : 0);
  writer.end_record(data_end);
  write_summary(end);
  append(end);
}

void McapWriter::write_summary(files::Bytes& out) const {
  const std::size_t begin = out.size();
  files::Bytes offsets;
  files::ByteWriter offset_writer(offsets);
  std::size_t group = begin;
  const auto end_group = [&](std::uint8_t opcode) {
    if (out.size() == group) return;
    const std::size_t at = offset_writer.begin_record(kSummaryOffset);
    offset_writer.number(opcode);
    offset_writer.number(static_cast<std::uint64_t>(file_.size() + group));
    offset_writer.number(static_cast<std::uint64_t>(out.size() - group));
    offset_writer.end_record(at);
    group = out.size();
  };
  for (const Schema& schema : schemas_) put_schema(schema, out);
  end_group(kSchema);
  for (const OpenChannel& channel : channels_) put_channel(channel.channel, out);
  end_group(kChannel);
  put_statistics(statistics_, schemas_.size(), channels_.size(), out);
  end_group(kStatistics);
  for (const ChunkIndex& chunk : chunks_) put_chunk_index(chunk, out);
  end_group(kChunkIndex);
  for (const MetadataIndex& metadata : metadata_) put_metadata_index(metadata, out);
  end_group(kMetadataIndex);

  const std::uint64_t offsets_start = file_.size() + out.size();
  out.insert(out.end(), offsets.begin(), offsets.end());
  files::ByteWriter writer(out);
  const std::size_t footer = writer.begin_record(kFooter);
  writer.number(static_cast<std::uint64_t>(file_.size() + begin));
  writer.number(offsets_start);
  writer.number(std::uint32_t{0});  // the CRC, below
  writer.end_record(footer);
  // The CRC covers the footer up to the CRC itself, its length included.
  files::ByteWriter::store(out.data() + out.size() - 4, crc(0, out.data() + begin, out.size() - 4 - begin));
  out.insert(out.end(), kMagic.begin(), kMagic.end());
}

}  // namespace inslab::mcap
