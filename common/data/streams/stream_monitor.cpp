#include "inslab/data/streams/stream_monitor.hpp"

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::streams {

StreamMonitor::StreamMonitor(std::string topic, StreamDirection direction)
    : topic_(std::move(topic)), direction_(direction) {}

bool StreamMonitor::received(const StreamHeader& header, std::int64_t received_realtime_ns) {
  if (header.run_id != run_id_) {
    *this = StreamMonitor(topic_, direction_);
    run_id_ = header.run_id;
  }
  ++samples_;
  if (header.publish_realtime_ns > 0) {
    latency_.add(time::to_seconds(received_realtime_ns - header.publish_realtime_ns));
  }
  if (header.sequence_number >= next_sequence_) {
    add_gap(next_sequence_, header.sequence_number);
    next_sequence_ = header.sequence_number + 1;
  } else if (fill_gap(header.sequence_number)) {
    // It was counted as lost when its successor came.
    --lost_;
    ++out_of_order_;
  } else {
    ++duplicates_;
    return false;
  }
  return true;
}

StreamProgress StreamMonitor::progress() const {
  StreamProgress progress{samples_, next_sequence_, lost_, {}};
  for (const auto& [first, end] : missing_) progress.missing.push_back({first, end - 1});
  return progress;
}

void StreamMonitor::go_on(const RunId& run, const StreamProgress& progress) {
  *this = StreamMonitor(topic_, direction_);
  run_id_ = run;
  samples_ = progress.samples;
  next_sequence_ = progress.next_sequence;
  lost_ = progress.lost;
  for (const NumberRange& range : progress.missing) missing_[range.first] = range.last + 1;
}

void StreamMonitor::add_gap(std::uint64_t first, std::uint64_t end) {
  if (first == end) return;
  // A stream this broken stays broken: beyond so many gaps the oldest can no longer fill, and counts as lost for good.
  constexpr std::size_t kMostGaps = 4096;
  if (missing_.size() >= kMostGaps) missing_.erase(missing_.begin());
  missing_.emplace(first, end);
  lost_ += end - first;
}

bool StreamMonitor::fill_gap(std::uint64_t sequence) {
  auto gap = missing_.upper_bound(sequence);
  if (gap == missing_.begin()) return false;
  --gap;
  const auto [first, end] = *gap;
  if (sequence >= end) return false;
  missing_.erase(gap);
  if (first < sequence) missing_.emplace(first, sequence);
  if (sequence + 1 < end) missing_.emplace(sequence + 1, end);
  return true;
}

StreamStatus StreamMonitor::status() const {
  StreamStatus status;
  status.topic = topic_;
  status.direction = direction_;
  status.samples = samples_;
  status.lost = lost_;
  status.out_of_order = out_of_order_;
  status.duplicates = duplicates_;
  status.latency_p50_s = latency_.quantile_s(0.5);
  status.latency_p99_s = latency_.quantile_s(0.99);
  status.latency_max_s = latency_.max_s();
  return status;
}

}  // namespace inslab::streams
