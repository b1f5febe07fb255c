#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "inslab/formats/mcap/mcap_format.hpp"

/// The records of an MCAP log as bytes, appended to `out`. Source: https://mcap.dev/spec.
namespace inslab::mcap {

/// Of every chunk of ours.
inline constexpr std::string_view kCompression = "zstd";

/// The magic bytes and the Header record.
void put_header(const std::string& profile, const std::string& library, std::vector<std::uint8_t>& out);
void put_schema(const Schema& schema, std::vector<std::uint8_t>& out);
void put_channel(const Channel& channel, std::vector<std::uint8_t>& out);
void put_statistics(const Statistics& statistics, std::size_t schemas, std::size_t channels,
                    std::vector<std::uint8_t>& out);
void put_chunk_index(const ChunkIndex& chunk, std::vector<std::uint8_t>& out);
void put_metadata_index(const MetadataIndex& metadata, std::vector<std::uint8_t>& out);

}  // namespace inslab::mcap
