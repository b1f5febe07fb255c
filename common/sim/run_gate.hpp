#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "inslab/data/requests/run_control.hpp"

namespace inslab::sim {

/// Whether the run may send its next truth sample, as the commands say: running, paused, so many steps left, stopped.
/// Judges commands; knows no clock and no bus.
class RunControl {
 public:
  RunControl(ClockMode clock, bool start_paused) : clock_(clock), paused_(start_paused) {}

  /// What a command changes.
  struct Verdict {
    std::string refusal;         ///< why nothing changed; empty when it was obeyed
    bool pace_changed = false;   ///< paused() is another one now
    std::optional<double> rate;  ///< the rate asked for
  };

  /// Obeys or refuses a command that arrives after `sent` truth samples.
  Verdict judge(const SimCommand& command, std::uint64_t sent);

  /// Takes note that `sent` samples are out; true when that was the last step, and the run is paused again.
  bool note_sent(std::uint64_t sent);

  bool paused() const { return paused_ && !stepping(); }
  bool stop_requested() const { return stop_; }
  /// Number of samples at which the run pauses, when it goes in steps.
  std::optional<std::uint64_t> pause_at() const { return pause_at_; }

 private:
  bool stepping() const { return pause_at_.has_value(); }

  ClockMode clock_;
  bool paused_;
  bool stop_ = false;
  std::optional<std::uint64_t> pause_at_;
};

}  // namespace inslab::sim
