#pragma once

#include <spdlog/spdlog.h>

#include <string>
#include <vector>

#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/state/state_stream.hpp"
#include "inslab/data/streams/credit_ledger.hpp"
#include "inslab/data/streams/sent_window.hpp"
#include "inslab/data/streams/stamp.hpp"
#include "inslab/data/streams/stream_monitor.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::service {

/// What is left until a deadline on CLOCK_MONOTONIC, never below 0.
inline std::chrono::nanoseconds time_left(time::Nanoseconds deadline) {
  return std::max(time::Nanoseconds(0), deadline - host::monotonic_now());
}

/// One stream as its producer sends it. In real time each sample goes out as one message; in lockstep samples go out in
/// blocks, and the producer stays a window ahead of the slowest consumer's credit. In both, what a consumer asks for
/// again is sent again in blocks, from the samples that are kept.
template <class Sample>
class StreamOutput {
 public:
  /// A block and a window stay small enough for the socket buffers that a stock kernel grants: what overflows them is
  /// repaired only after a heartbeat.
  static constexpr std::size_t kBlockSamples = 32;
  static constexpr std::uint64_t kWindowSamples = 128;

  /// Samples that a logger that is killed in real time may still ask for when it is back: those of half a minute, which
  /// it may need on a host that is busy with starting others too.
  static std::size_t half_a_minute(double rate_hz) {
    return static_cast<std::size_t>(std::clamp(30.0 * rate_hz, 2.0 * kWindowSamples, 30'000.0));
  }

  struct Settings {
    std::vector<streams::ConsumerKey> consumers;  ///< of ours; each reads the single samples and the blocks
    bool paced_by_nav_app = false;                ///< the app under test is a consumer too, see TruthFollower
    std::uint64_t window = kWindowSamples;        ///< lockstep: samples ahead of the slowest credit
    std::size_t kept = 2 * kWindowSamples;        ///< samples that can be asked for again
  };

  StreamOutput(Context& context, const dds::Topic<Sample>& topic, const Settings& settings)
      : topic_(topic.name),
        own_readers_(static_cast<int>(settings.consumers.size())),
        window_samples_(settings.window),
        ledger_(topic.name, with_nav_app(settings)),
        window_(settings.kept),
        sent_(topic.name, StreamDirection::Out),
        samples_(context.participant(), topic),
        blocks_(context.participant(), dds::topics::block(topic)) {
    for (const auto& required : context.scenario().scenario.require_subscribers) {
      if (required.topic == topic.name) foreign_needed_ += static_cast<int>(required.count);
    }
  }

  void begin_run(const RunId& run, ClockMode clock) {
    run_ = run;
    lockstep_ = clock == ClockMode::Lockstep;
  }

  /// What it needs to go on from here in another process (data/state/state_stream.hpp); call begin_run() before.
  void save(state::StateWriter& writer) const { writer(next_, sent_.samples()); }
  void load(state::StateReader& reader) {
    std::uint64_t samples = 0;
    reader(next_, samples);
    sent_.go_on(run_, {samples, next_, 0, {}});
    // Consumers may have more than this process knows of: what the other one sent after it saved its state.
    ahead_ = window_samples_ + kBlockSamples;
  }

  /// Sends a sample, with the clocks of this moment in its header; in lockstep, once its block is full.
  void put(Sample& sample) {
    streams::stamped(sample);
    window_.add(sample);
    next_ = sample.header.sequence_number + 1;
    if (!lockstep_) {
      if (samples_.write(sample)) sent_.sent();
      return;
    }
    sent_.sent();
    if (ledger_.lowest().value_or(0) > sample.header.sequence_number) return;  // all had it of the process before
    // An app that reads single samples takes part in lockstep too: its imu_sequence paces it.
    if (foreign_readers() > 0) samples_.write(sample);
    gathered_.samples.push_back(sample);
    if (gathered_.samples.size() == kBlockSamples) flush_block();
  }

  /// Sends what has been gathered.
  void flush_block() {
    if (gathered_.samples.empty()) return;
    blocks_.write(gathered_);
    gathered_.samples.clear();
  }

  /// The sequence number that follows the newest sample put.
  std::uint64_t next_sequence() const { return next_; }
  /// Whether another sample may be put: always in real time.
  bool has_room() const { return !lockstep_ || next_ < ledger_.lowest().value_or(next_) + window_samples_; }

  /// Takes a credit for this stream, and sends again what it asks for.
  void take(const Credit& credit) {
    if (credit.next_sequence > next_ + ahead_ || !ledger_.take(credit, run_, host::monotonic_now())) return;
    if (lockstep_) leave_behind();
    if (lockstep_) window_.forget_before(ledger_.lowest().value_or(0));
    if (!credit.resend || credit.next_sequence >= next_ || window_.empty()) return;
    if (is_on_its_way(credit.next_sequence)) return;
    flush_block();
    resent_from_ = resent_until_ = credit.next_sequence;
    resent_at_ = host::monotonic_now();
    for (std::uint64_t sent = 0; sent < kWindowSamples;) {
      const Block<Sample> block = window_.from(resent_until_, kBlockSamples);
      if (block.samples.empty()) break;
      blocks_.write(block);
      resent_until_ = block.samples.back().header.sequence_number + 1;
      sent += block.samples.size();
    }
  }

  const std::string& topic() const { return topic_; }
  /// The least sample that a consumer may still ask for.
  std::uint64_t lowest_wanted() const { return ledger_.lowest().value_or(next_); }
  /// Whether the logger has said that it has everything.
  bool is_logged() const { return ledger_.has_all_before(next_, {catalog::kTruthLogger, 0u}); }
  std::string slowest_consumer() const { return ledger_.slowest(); }
  int foreign_readers() const { return samples_.matched_readers() - own_readers_; }
  /// Which readers are missing of our own and of the foreign ones that the scenario demands; empty when none.
  std::string missing_readers() const {
    if (samples_.matched_readers() < own_readers_ || blocks_.matched_readers() < own_readers_) {
      return "waits for a reader of " + topic_;
    }
    const int missing = foreign_missing();
    if (missing == 0) return "";
    return scenario::kWaitsForApp + (missing == 1 ? "a reader of " : std::to_string(missing) + " readers of ") + topic_;
  }
  StreamStatus status() const { return sent_.status(); }
  /// Waits until every reader has everything, at the latest until `deadline` (CLOCK_MONOTONIC): one that is stuck must
  /// not keep the process from ending.
  void wait_for_acknowledgments(time::Nanoseconds deadline) {
    samples_.wait_for_acknowledgments(time_left(deadline));
    blocks_.wait_for_acknowledgments(time_left(deadline));
  }

 private:
  /// Whether a sample has just been sent again. Every consumer gets what one asks for; if each of sixteen that begin
  /// together had it sent again for itself, all of them would drown in it. What is lost once more is asked for again.
  bool is_on_its_way(std::uint64_t sequence) const {
    const time::Nanoseconds lately = lockstep_ ? std::chrono::milliseconds(150) : std::chrono::milliseconds(10);
    return sequence >= resent_from_ && sequence < resent_until_ && host::monotonic_now() - resent_at_ < lately;
  }

  /// Of consumers that nobody expected, those that hold up the run: our own say every 200 ms how far they are.
  void leave_behind() {
    const std::string names = ledger_.leave_behind(next_, host::monotonic_now());
    if (names.empty()) return;
    spdlog::warn("{}: {} has not come on for {} s: the run no longer waits for it", topic_, text::shown(names),
                 std::chrono::duration_cast<std::chrono::seconds>(streams::CreditLedger::kPatience).count());
  }
  static std::vector<streams::ConsumerKey> with_nav_app(const Settings& settings) {
    std::vector<streams::ConsumerKey> consumers = settings.consumers;
    if (settings.paced_by_nav_app) consumers.emplace_back(scenario::kNavApp, 0u);
    return consumers;
  }
  /// A foreign app reads the single samples, or in lockstep the blocks.
  int foreign_missing() const {
    const int on_blocks = blocks_.matched_readers() - own_readers_;
    return std::max(0, foreign_needed_ - std::max(0, foreign_readers()) - std::max(0, on_blocks));
  }

  std::string topic_;
  int own_readers_;
  std::uint64_t window_samples_;
  int foreign_needed_ = 0;
  RunId run_;
  bool lockstep_ = false;
  std::uint64_t next_ = 0;
  std::uint64_t ahead_ = 0;  ///< how far beyond next_ a credit may be
  streams::CreditLedger ledger_;
  streams::SentWindow<Sample> window_;
  std::uint64_t resent_from_ = 0;
  std::uint64_t resent_until_ = 0;
  time::Nanoseconds resent_at_{0};  ///< CLOCK_MONOTONIC
  Block<Sample> gathered_;
  streams::StreamMonitor sent_;
  dds::Writer<Sample> samples_;
  dds::Writer<Block<Sample>> blocks_;
};

}  // namespace inslab::service
