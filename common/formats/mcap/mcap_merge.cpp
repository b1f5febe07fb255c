#include "inslab/formats/mcap/mcap_merge.hpp"

#include <algorithm>
#include <utility>

namespace inslab::mcap {

LogTimeMerge::LogTimeMerge(const files::InputFile& file, std::vector<ChunkIndex> chunks,
                           std::set<std::uint16_t> channels, std::uint64_t max_chunk_bytes,
                           std::uint64_t max_open_bytes)
    : file_(file),
      chunks_(std::move(chunks)),
      channels_(std::move(channels)),
      max_chunk_bytes_(max_chunk_bytes),
      max_open_bytes_(max_open_bytes) {
  std::stable_sort(chunks_.begin(), chunks_.end(),
                   [](const auto& a, const auto& b) { return a.start_time_ns < b.start_time_ns; });
}

bool LogTimeMerge::next(Message& message) {
  if (current_ != nullptr) {
    if (++current_->at < current_->entries.size()) {
      open_.push(std::move(current_));
    } else {
      open_bytes_ -= current_->chunk.size();
    }
    current_.reset();
  }
  while (next_chunk_ < chunks_.size() && (open_.empty() || chunks_[next_chunk_].start_time_ns <= open_.top()->time())) {
    open(chunks_[next_chunk_++]);
  }
  if (open_.empty()) return false;
  current_ = open_.top();
  open_.pop();
  message = current_->chunk.message_at(current_->entries[current_->at].position);
  return true;
}

void LogTimeMerge::open(const ChunkIndex& index) {
  auto cursor = std::make_shared<Cursor>(Cursor{Chunk(file_, index.offset, index.length, max_chunk_bytes_), {}, 0});
  if (cursor->chunk.head().start_time_ns != index.start_time_ns) {
    throw files::ReadError(file_.path(), index.offset, "a chunk with the start time that its index gives");
  }
  cursor->entries = cursor->chunk.messages(channels_);
  if (cursor->entries.empty()) return;
  std::stable_sort(cursor->entries.begin(), cursor->entries.end(),
                   [](const auto& a, const auto& b) { return a.log_time_ns < b.log_time_ns; });
  open_bytes_ += cursor->chunk.size();
  if (open_bytes_ > max_open_bytes_) {
    throw files::ReadError(file_.path(), index.offset,
                           "chunks that overlap in time by at most " + std::to_string(max_open_bytes_) + " bytes");
  }
  open_.push(std::move(cursor));
}

}  // namespace inslab::mcap
