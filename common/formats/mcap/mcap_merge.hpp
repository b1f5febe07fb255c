#pragma once

#include <cstdint>
#include <memory>
#include <queue>
#include <set>
#include <vector>

#include "inslab/formats/mcap/mcap_chunk.hpp"

namespace inslab::mcap {

/// The messages of several chunks in the order of their log times, equal times in file order. A chunk is read when it
/// may hold the next message and dropped after its last, so what is in memory are the chunks that overlap in time.
class LogTimeMerge {
 public:
  /// `chunks` in file order. `channels`: those wanted; all when empty. At most `max_open_bytes` of chunks at once.
  LogTimeMerge(const files::InputFile& file, std::vector<ChunkIndex> chunks, std::set<std::uint16_t> channels,
               std::uint64_t max_chunk_bytes, std::uint64_t max_open_bytes);

  /// The next message, valid until the next call; false at the end. Throws ReadError.
  bool next(Message& message);

 private:
  struct Cursor {
    Chunk chunk;
    std::vector<Chunk::Entry> entries;
    std::size_t at = 0;

    std::uint64_t time() const { return entries[at].log_time_ns; }
  };
  struct Later {
    bool operator()(const std::shared_ptr<Cursor>& a, const std::shared_ptr<Cursor>& b) const {
      return a->time() != b->time() ? a->time() > b->time() : a->chunk.offset() > b->chunk.offset();
    }
  };

  void open(const ChunkIndex& index);

  const files::InputFile& file_;
  std::vector<ChunkIndex> chunks_;  ///< by start time
  std::set<std::uint16_t> channels_;
  std::uint64_t max_chunk_bytes_;
  std::uint64_t max_open_bytes_;
  std::size_t next_chunk_ = 0;
  std::uint64_t open_bytes_ = 0;
  std::priority_queue<std::shared_ptr<Cursor>, std::vector<std::shared_ptr<Cursor>>, Later> open_;
  std::shared_ptr<Cursor> current_;  ///< holds the message handed out last
};

}  // namespace inslab::mcap
