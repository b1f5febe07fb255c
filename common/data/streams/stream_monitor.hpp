#pragma once

#include <map>
#include <vector>

#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/stream_header.hpp"
#include "inslab/foundation/host/latency_histogram.hpp"

namespace inslab::streams {

/// Numbers without a gap.
struct NumberRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("first"), self.first);
    visit(Field("last"), self.last);
  }
};

/// What has come of a stream, for another process of the same service.
struct StreamProgress {
  std::uint64_t samples = 0;
  std::uint64_t next_sequence = 0;   ///< one past the newest
  std::uint64_t lost = 0;            ///< of those before, how many have not come
  std::vector<NumberRange> missing;  ///< which of them may still come

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("samples"), self.samples);
    visit(Field("next_sequence"), self.next_sequence);
    visit(Field("lost"), self.lost);
    visit(Field("missing").at_most(4096), self.missing);
  }
};

/// Counts one stream from its sequence numbers: what came, what is missing, what came late or twice, and how old it
/// was.
class StreamMonitor {
 public:
  StreamMonitor(std::string topic, StreamDirection direction);

  /// A sample received at `received_realtime_ns`; another run id starts the counts afresh. False when it came before.
  bool received(const StreamHeader& header, std::int64_t received_realtime_ns);
  /// What has come so far, for another process to go on with.
  StreamProgress progress() const;
  /// Goes on from where another process of the same service stopped.
  void go_on(const RunId& run, const StreamProgress& progress);
  /// A sample sent.
  void sent() { ++samples_; }

  const std::string& topic() const { return topic_; }
  std::uint64_t samples() const { return samples_; }
  /// Those that came, each counted once.
  std::uint64_t came() const { return next_sequence_ - lost_; }
  std::uint64_t lost() const { return lost_; }
  std::uint64_t next_sequence() const { return next_sequence_; }
  /// The least sample that has not come.
  std::uint64_t first_missing() const { return missing_.empty() ? next_sequence_ : missing_.begin()->first; }
  StreamStatus status() const;

 private:
  void add_gap(std::uint64_t first, std::uint64_t end);
  /// Takes a number out of the gaps; false when it is in none: it came before.
  bool fill_gap(std::uint64_t sequence);

  std::string topic_;
  StreamDirection direction_;
  RunId run_id_;
  std::uint64_t samples_ = 0;
  std::uint64_t next_sequence_ = 0;
  std::map<std::uint64_t, std::uint64_t> missing_;  // gaps that may still fill: first number to one past the last
  std::uint64_t lost_ = 0;
  std::uint64_t out_of_order_ = 0;
  std::uint64_t duplicates_ = 0;
  host::LatencyHistogram latency_;
};

}  // namespace inslab::streams
