#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "inslab/formats/mcap/mcap_records.hpp"
#include "inslab/foundation/files/input_file.hpp"

namespace inslab::mcap {

/// The records of one chunk, decompressed and checked.
class Chunk {
 public:
  /// Reads the Chunk record of `length` bytes (its head included) at `offset`. Throws ReadError when it is not one, its
  /// compression is neither "zstd" nor none, its CRC is wrong or it holds more than `max_bytes`.
  Chunk(const files::InputFile& file, std::uint64_t offset, std::uint64_t length, std::uint64_t max_bytes);

  const ChunkHead& head() const { return head_; }
  std::uint64_t offset() const { return offset_; }
  std::size_t size() const { return records_.size(); }

  /// Calls `visit` with the opcode and content of every record. Throws ReadError when one does not fit, or what
  /// `visit` throws; offsets in errors are the chunk's own.
  void for_each_record(const std::function<void(std::uint8_t, files::ByteReader)>& visit) const;

  /// The message whose record begins `position` bytes into the chunk.
  Message message_at(std::size_t position) const;

  struct Entry {
    std::uint64_t log_time_ns;
    std::uint32_t position;  ///< for message_at()
  };
  /// The messages of `channels` (all when empty) in file order. Throws ReadError when a log time lies outside the
  /// chunk's.
  std::vector<Entry> messages(const std::set<std::uint16_t>& channels) const;

 private:
  std::uint64_t offset_;
  std::string place_;  ///< for error messages
  ChunkHead head_;
  std::vector<std::uint8_t> records_;
};

}  // namespace inslab::mcap
