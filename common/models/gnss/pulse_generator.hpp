#pragma once

#include <optional>

#include "inslab/data/profiles/pulse_errors.hpp"
#include "inslab/data/samples/pulse_per_second.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::gnss {

/// A pulse and what is true of it.
struct Pulse {
  PulsePerSecond sample;
  PulseTruth truth;
};

/// The pulse per second of one receiver.
///
/// The pulse of the whole second S of GPS time is meant for
///
///   m = S + offset + jitter + drift (S - last fix)      the last in holdover alone
///
/// and rises with the nearest tick of an oscillator of the period q that is off by d: in ticks its phase goes on by
/// frac((1 + d)/q) a second, from a phase drawn once, so that what is left to the nearest tick is a sawtooth within
/// +-q/2. The receiver knows that remainder and says it. There is none before the first fix, none when the newest epoch
/// before S had no fix and the last one is longer ago than the holdover, and one in so many is missing. Draws depend on
/// (stream, S) alone.
class PulseGenerator {
 public:
  /// Streams "<root>/white", "/missing", "/phase".
  explicit PulseGenerator(const random::Stream& root);

  void use(const PulseErrors& errors) { errors_ = errors; }

  /// What the receiver's epoch at a sim time gave, told after at() of that time.
  void note_epoch(std::int64_t sim_time_ns, bool has_fix);

  /// The pulse that has risen by `truth`'s time and not before the truth sample before it; `revisions` are those of
  /// that time. Truth comes in order, without gaps. A pulse that rises before its second comes at that second.
  std::optional<Pulse> at(const TruthState& truth, const GnssRevisions& revisions);

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.has_fix_, self.last_fix_ns_, self.is_due_, self.due_.sample, self.due_.truth);
  }

 private:
  std::optional<Pulse> pulse_of(const StreamHeader& second);
  double to_the_next_tick_ns(std::uint64_t second, double meant_ns) const;

  PulseErrors errors_;
  random::NormalCursor white_;
  random::Stream missing_;
  double first_phase_ticks_;
  bool has_fix_ = false;
  std::int64_t last_fix_ns_ = -1;  ///< below 0: none yet
  bool is_due_ = false;
  Pulse due_;  ///< that has not risen yet
};

}  // namespace inslab::gnss
