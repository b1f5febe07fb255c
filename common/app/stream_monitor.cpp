#include "app/stream_monitor.hpp"

namespace inslab::app {

StreamMonitor::StreamMonitor(std::string topic, StreamDirection direction)
    : topic_(std::move(topic)), direction_(direction) {}

void StreamMonitor::received(const StreamHeader& header, std::int64_t received_realtime_ns) {
  if (header.run_id != run_id_) {
    *this = StreamMonitor(topic_, direction_);
    run_id_ = header.run_id;
  }
  ++samples_;
  if (header.publish_realtime_ns > 0) {
    latency_.add(static_cast<double>(received_realtime_ns - header.publish_realtime_ns) * 1e-9);
  }
  if (header.sequence_number >= next_sequence_) {
    lost_ += header.sequence_number - next_sequence_;
    next_sequence_ = header.sequence_number + 1;
  } else if (lost_ > 0) {
    // It was counted as lost when its successor came.
    --lost_;
    ++out_of_order_;
  } else {
    ++duplicates_;
  }
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

}  // namespace inslab::app
