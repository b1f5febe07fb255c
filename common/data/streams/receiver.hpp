#pragma once

#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inslab/data/streams/demand.hpp"
#include "inslab/data/streams/stream_monitor.hpp"

namespace inslab::streams {

/// What came in one message of a stream: one sample, or in lockstep a block of them.
template <class Sample>
struct Arrived {
  std::vector<Sample> samples;
  std::int64_t received_realtime_ns = 0;
};

/// The receiver of one stream of one run: hands on its samples in their order, each once, however they come, counts
/// them, and says when to ask for what is missing (data/streams/demand.hpp). Knows no bus and no clock.
template <class Sample>
class Receiver {
 public:
  struct Next {
    Sample sample;
    bool ends_message;  ///< the last of the message in which it came
  };

  explicit Receiver(std::string topic) : monitor_(std::move(topic), StreamDirection::In) {}

  /// From now on samples of `run` count, from the first on.
  void begin_run(const RunId& run, const DemandPolicy& policy, time::Nanoseconds now) {
    run_ = run;
    next_ = 0;
    pending_.clear();
    demand_.begin(policy, now);
  }
  /// Another process of this service has handed on everything before `next`.
  void go_on(std::uint64_t next) {
    next_ = next;
    monitor_.go_on(run_, {next, next, 0, {}});
  }

  /// Takes what came. Samples of another run are left out: until its status comes nobody knows that it is the run, and
  /// then they are asked for.
  void add(const Arrived<Sample>& arrived, time::Nanoseconds now) {
    if (run_ == RunId{}) return;
    for (const Sample& sample : arrived.samples) {
      if (sample.header.run_id != run_) continue;
      const bool is_new = monitor_.received(sample.header, arrived.received_realtime_ns);
      if (is_new) demand_.came(now);
      if (sample.header.sequence_number < next_) continue;
      pending_.insert_or_assign(sample.header.sequence_number, Next{sample, &sample == &arrived.samples.back()});
    }
  }

  /// The next sample in order; null when it has not come. What is given up is skipped where the policy says so.
  const Next* front(time::Nanoseconds now) const {
    if (pending_.empty()) return nullptr;
    const auto& [number, sample] = *pending_.begin();
    const bool is_next = number == next_ || (demand_.policy().skips && demand_.gave_up(next_, now));
    return is_next ? &sample : nullptr;
  }
  /// Done with front().
  void pop() {
    next_ = pending_.begin()->first + 1;
    pending_.erase(pending_.begin());
  }
  /// Both at once.
  std::optional<Sample> take(time::Nanoseconds now) {
    if (front(now) == nullptr) return std::nullopt;
    std::optional<Sample> sample(std::move(pending_.begin()->second.sample));
    pop();
    return sample;
  }

  /// What the consumer knows besides.
  struct Consumer {
    bool moved = false;                 ///< it is further than it has said
    bool has_work = false;              ///< it has not done with what it took: that nothing comes is its own doing
    std::optional<std::uint64_t> sent;  ///< samples of the whole stream, when that is known
  };
  /// What to say to the producer now.
  std::optional<Ask> look(const Consumer& consumer, time::Nanoseconds now) {
    if (run_ == RunId{}) return std::nullopt;
    Known known;
    known.next = next_;
    known.newer_came = has_gap();
    known.more_was_sent = consumer.sent && pending_.empty() && next_ < *consumer.sent;
    known.more_may_have_been_sent = pending_.empty() && !consumer.has_work && !consumer.sent;
    known.moved = consumer.moved;
    return demand_.look(known, now);
  }

  /// The least sample that has not been handed on.
  std::uint64_t next() const { return next_; }
  bool has_gap() const { return !pending_.empty() && pending_.begin()->first > next_; }
  /// Whether nothing waits to be handed on, behind a gap or not.
  bool empty() const { return pending_.empty(); }
  /// First and last of the samples without which there is no going on, and which will not come.
  std::optional<std::pair<std::uint64_t, std::uint64_t>> lost(time::Nanoseconds now) const {
    if (!has_gap() || demand_.policy().skips || !demand_.gave_up(next_, now)) return std::nullopt;
    return std::pair(next_, pending_.begin()->first - 1);
  }
  const StreamMonitor& monitor() const { return monitor_; }

 private:
  RunId run_;
  std::uint64_t next_ = 0;
  std::map<std::uint64_t, Next> pending_;  ///< not handed on yet, by sequence number
  StreamMonitor monitor_;
  Demand demand_;
};

}  // namespace inslab::streams
