#pragma once

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"

namespace inslab::host {

/// Whether a signal ends a service now. When everybody is told to stop at once, the end of the run is on its way from
/// the trajectory server: a service in a run waits for it a little, so that one that is stopped with its set is not
/// taken for one that left a run.
class StopGrace {
 public:
  static constexpr time::Nanoseconds kGrace = std::chrono::milliseconds(800);

  /// `in_a_run`: a run has begun, and this service has not done with it.
  bool must_stop(bool in_a_run) {
    if (!shutdown_requested()) return false;
    if (told_at_ == time::Nanoseconds(0)) told_at_ = monotonic_now();
    return !in_a_run || monotonic_now() - told_at_ > kGrace;
  }

 private:
  time::Nanoseconds told_at_{0};  ///< CLOCK_MONOTONIC; 0: no signal yet
};

}  // namespace inslab::host
