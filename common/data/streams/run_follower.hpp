#pragma once

#include <string>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/streams/log_word.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::streams {

/// Which run somebody follows, and how that run is. Knows no bus and no clock.
///
/// A run that has begun is followed to its end, whatever is said of another one: a second trajectory server must not
/// turn anybody's head.
class RunFollower {
 public:
  enum class Phase { Waiting, Begun, Ended };
  /// When another run takes the place of the one that is followed.
  enum class Changes {
    WhileItWaits,  ///< a service: its server may be started again before the run, and it serves no other after that
    WhenItEnded,   ///< a command: it stays with the first of which it hears, and goes on to the next
  };
  enum class Heard {
    OfAnother,  ///< this run is not followed
    OfTheRun,   ///< nothing that changes what to do
    TheRun,     ///< from now on this is the run; it may have ended already
    ItsEnd,     ///< the run has ended
  };

  /// `only`: the one run that may be followed; zero: any.
  explicit RunFollower(const RunId& only = {}, Changes changes = Changes::WhileItWaits)
      : only_(only), changes_(changes) {}

  /// Goes on with a run that another process of this service has followed.
  void go_on(const RunId& run, ClockMode clock, Phase phase, time::Nanoseconds now);
  /// Takes a trajectory server's status.
  Heard hear(const SimStatus& status, time::Nanoseconds now);
  /// A sample of the run was handled: it has begun, whatever its status says.
  void note_sample(time::Nanoseconds now) {
    if (phase_ == Phase::Waiting) enter(Phase::Begun, now);
  }
  /// Takes a credit when it is the logger's word on its log; false when it is another one.
  bool take(const Credit& credit) { return log_word_.take(credit); }

  /// Zero: none yet.
  const RunId& run() const { return run_; }
  /// Whether a sample of that run may count: before a run is known, of any that may be followed.
  bool takes(const RunId& run) const { return run_ == RunId{} ? may_change_to(run) : run == run_; }
  ClockMode clock() const { return clock_; }
  bool is_lockstep() const { return clock_ == ClockMode::Lockstep; }
  Phase phase() const { return phase_; }
  bool has_begun() const { return phase_ != Phase::Waiting; }
  bool has_ended() const { return phase_ == Phase::Ended; }
  /// Whether it ended longer than `patience` ago.
  bool ended_before(time::Nanoseconds patience, time::Nanoseconds now) const {
    return has_ended() && now - since_ > patience;
  }
  /// Truth samples of the run that has ended.
  std::uint64_t truth_samples() const { return truth_samples_; }
  /// Why it ended as a fault; empty: it did not.
  const std::string& fault() const { return fault_; }

  /// Whether the logger has closed its log of this run, or has left it.
  bool log_is_closed() const { return log_word_.is_closed(run_); }
  /// Whether to stay for a logger that has not closed its log: one that was killed at the end has what came before,
  /// and hears the last word of a service when it is back.
  bool stays_for_the_log(time::Nanoseconds now) const {
    return has_ended() && !log_is_closed() && !ended_before(kTimeToComeBack, now);
  }
  /// Once in a run: that wait has grown long, which is said.
  bool tells_the_wait(time::Nanoseconds now);

 private:
  bool may_change_to(const RunId& run) const;
  void enter(Phase phase, time::Nanoseconds now);

  RunId only_;
  Changes changes_;
  RunId run_;
  ClockMode clock_ = ClockMode::RealTime;
  Phase phase_ = Phase::Waiting;
  time::Nanoseconds since_{0};  ///< of the phase
  std::uint64_t truth_samples_ = 0;
  std::string fault_;
  LogWord log_word_;
  bool told_ = false;
};

}  // namespace inslab::streams
