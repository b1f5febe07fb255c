#include "inslab/formats/mcap/mcap_put.hpp"

#include "inslab/foundation/files/byte_writer.hpp"

namespace inslab::mcap {

void put_header(const std::string& profile, const std::string& library, files::Bytes& out) {
  files::ByteWriter writer(out);
  out.insert(out.end(), kMagic.begin(), kMagic.end());
  const std::size_t at = writer.begin_record(kHeader);
  writer.text(profile);
  writer.text(library);
  writer.end_record(at);
}

void put_schema(const Schema& schema, files::Bytes& out) {
  files::ByteWriter writer(out);
  const std::size_t at = writer.begin_record(kSchema);
  writer.number(schema.id);
  writer.text(schema.name);
  writer.text(schema.encoding);
  writer.text(schema.text);
  writer.end_record(at);
}

void put_channel(const Channel& channel, files::Bytes& out) {
  files::ByteWriter writer(out);
  const std::size_t at = writer.begin_record(kChannel);
  writer.number(channel.id);
  writer.number(channel.schema_id);
  writer.text(channel.topic);
  writer.text(channel.message_encoding);
  writer.text_map(channel.metadata);
  writer.end_record(at);
}

void put_statistics(const Statistics& statistics, std::size_t schemas, std::size_t channels, files::Bytes& out) {
  files::ByteWriter writer(out);
  const std::size_t at = writer.begin_record(kStatistics);
  writer.number(statistics.message_count);
  writer.number(static_cast<std::uint16_t>(schemas));
  writer.number(static_cast<std::uint32_t>(channels));
  writer.number(std::uint32_t{0});  // attachments
  writer.number(statistics.metadata_count);
  writer.number(statistics.chunk_count);
  writer.number(statistics.message_start_time_ns);
  writer.number(statistics.message_end_time_ns);
  const std::size_t counts = writer.begin_block();
  for (const auto& [channel, count] : statistics.channel_message_counts) {
    writer.number(channel);
    writer.number(count);
  }
  writer.end_block(counts);
  writer.end_record(at);
}

void put_chunk_index(const ChunkIndex& chunk, files::Bytes& out) {
  files::ByteWriter writer(out);
  const std::size_t at = writer.begin_record(kChunkIndex);
  writer.number(chunk.start_time_ns);
  writer.number(chunk.end_time_ns);
  writer.number(chunk.offset);
  writer.number(chunk.length);
  const std::size_t offsets = writer.begin_block();
  for (const auto& [channel, offset] : chunk.message_index_offsets) {
    writer.number(channel);
    writer.number(offset);
  }
  writer.end_block(offsets);
  writer.number(chunk.message_index_length);
  writer.text(kCompression);
  writer.number(chunk.compressed_size);
  writer.number(chunk.uncompressed_size);
  writer.end_record(at);
}

void put_metadata_index(const MetadataIndex& metadata, files::Bytes& out) {
  files::ByteWriter writer(out);
  const std::size_t at = writer.begin_record(kMetadataIndex);
  writer.number(metadata.offset);
  writer.number(metadata.length);
  writer.text(metadata.name);
  writer.end_record(at);
}

}  // namespace inslab::mcap
