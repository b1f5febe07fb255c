#include "inslab/formats/mcap/mcap_records.hpp"

namespace inslab::mcap {

Schema parse_schema(files::ByteReader reader) {
  const std::uint64_t offset = reader.file_offset();
  Schema schema;
  schema.id = reader.number<std::uint16_t>("schema id");
  if (schema.id == 0) throw files::ReadError(reader.path(), offset, "a schema id above 0");
  schema.name = reader.text("schema name");
  schema.encoding = reader.text("schema encoding");
  schema.text = reader.text("schema text");
  return schema;
}

Channel parse_channel(files::ByteReader reader) {
  Channel channel;
  channel.id = reader.number<std::uint16_t>("channel id");
  channel.schema_id = reader.number<std::uint16_t>("channel's schema id");
  channel.topic = reader.text("topic");
  channel.message_encoding = reader.text("message encoding");
  channel.metadata = reader.text_map("channel metadata");
  return channel;
}

Message parse_message(files::ByteReader reader) {
  Message message;
  message.channel_id = reader.number<std::uint16_t>("message channel id");
  message.sequence = reader.number<std::uint32_t>("message sequence");
  message.log_time_ns = reader.number<std::uint64_t>("message log time");
  message.publish_time_ns = reader.number<std::uint64_t>("message publish time");
  message.size = reader.left();
  message.data = reader.take(message.size, "message");
  return message;
}

Metadata parse_metadata(files::ByteReader reader) {
  Metadata metadata;
  metadata.name = reader.text("metadata name");
  metadata.values = reader.text_map("metadata");
  return metadata;
}

MetadataIndex parse_metadata_index(files::ByteReader reader) {
  MetadataIndex index;
  index.offset = reader.number<std::uint64_t>("metadata offset");
  index.length = reader.number<std::uint64_t>("metadata length");
  index.name = reader.text("metadata name");
  return index;
}

Statistics parse_statistics(files::ByteReader reader) {
  Statistics statistics;
  statistics.message_count = reader.number<std::uint64_t>("message count");
  reader.number<std::uint16_t>("schema count");
  reader.number<std::uint32_t>("channel count");
  reader.number<std::uint32_t>("attachment count");
  statistics.metadata_count = reader.number<std::uint32_t>("metadata count");
  statistics.chunk_count = reader.number<std::uint32_t>("chunk count");
  statistics.message_start_time_ns = reader.number<std::uint64_t>("message start time");
  statistics.message_end_time_ns = reader.number<std::uint64_t>("message end time");
  files::ByteReader counts = reader.block("message counts");
  while (counts.left() > 0) {
    const auto channel = counts.number<std::uint16_t>("channel id");
    statistics.channel_message_counts[channel] = counts.number<std::uint64_t>("message count");
  }
  return statistics;
}

ChunkHead parse_chunk_head(files::ByteReader& reader) {
  ChunkHead head;
  head.start_time_ns = reader.number<std::uint64_t>("chunk start time");
  head.end_time_ns = reader.number<std::uint64_t>("chunk end time");
  head.uncompressed_size = reader.number<std::uint64_t>("chunk size");
  head.uncompressed_crc = reader.number<std::uint32_t>("chunk CRC");
  head.compression = reader.text("chunk compression");
  head.compressed_size = reader.number<std::uint64_t>("compressed size");
  return head;
}

ChunkIndex parse_chunk_index(files::ByteReader reader) {
  ChunkIndex index;
  index.start_time_ns = reader.number<std::uint64_t>("chunk start time");
  index.end_time_ns = reader.number<std::uint64_t>("chunk end time");
  index.offset = reader.number<std::uint64_t>("chunk offset");
  index.length = reader.number<std::uint64_t>("chunk length");
  files::ByteReader offsets = reader.block("message index offsets");
  while (offsets.left() > 0) {
    const auto channel = offsets.number<std::uint16_t>("channel id");
    index.message_index_offsets[channel] = offsets.number<std::uint64_t>("message index offset");
  }
  index.message_index_length = reader.number<std::uint64_t>("message index length");
  reader.text("chunk compression");
  index.compressed_size = reader.number<std::uint64_t>("compressed size");
  index.uncompressed_size = reader.number<std::uint64_t>("chunk size");
  return index;
}

Footer parse_footer(files::ByteReader reader) {
  Footer footer;
  footer.summary_start = reader.number<std::uint64_t>("summary start");
  footer.summary_offset_start = reader.number<std::uint64_t>("summary offset start");
  footer.summary_crc = reader.number<std::uint32_t>("summary CRC");
  return footer;
}

}  // namespace inslab::mcap
