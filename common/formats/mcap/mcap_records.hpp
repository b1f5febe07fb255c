#pragma once

#include <cstdint>

#include "inslab/formats/mcap/mcap_format.hpp"
#include "inslab/foundation/files/byte_reader.hpp"

/// The content of MCAP records, out of their bytes; each throws ReadError. Source: https://mcap.dev/spec.
namespace inslab::mcap {

/// What begins a Chunk record; the compressed records follow it.
struct ChunkHead {
  std::uint64_t start_time_ns = 0;
  std::uint64_t end_time_ns = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: not known
  std::string compression;
  std::uint64_t compressed_size = 0;
};

/// Where the summary lies.
struct Footer {
  std::uint64_t summary_start = 0;         ///< 0: there is none
  std::uint64_t summary_offset_start = 0;  ///< 0: there are no summary offsets
  std::uint32_t summary_crc = 0;           ///< 0: not known
};

Schema parse_schema(files::ByteReader reader);
Channel parse_channel(files::ByteReader reader);
Message parse_message(files::ByteReader reader);
Metadata parse_metadata(files::ByteReader reader);
MetadataIndex parse_metadata_index(files::ByteReader reader);
Statistics parse_statistics(files::ByteReader reader);
ChunkHead parse_chunk_head(files::ByteReader& reader);
ChunkIndex parse_chunk_index(files::ByteReader reader);
Footer parse_footer(files::ByteReader reader);

}  // namespace inslab::mcap
