#pragma once

#include <cstdint>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::sim {

/// Which instant of CLOCK_MONOTONIC belongs to which sim time of a real-time run. Sim time goes on at `rate` times real
/// time while the run is not paused; pausing and changing the rate bend the line, nothing else moves it, so a late
/// sample never shifts the deadlines after it. Reads no clock: the caller says what time it is.
class RunClock {
 public:
  /// Sim time 0 lies at `zero`; rate in sim seconds per second, above 0.
  RunClock(time::Nanoseconds zero, double rate) : anchor_monotonic_(zero), rate_(rate) {}

  /// When the sample of `sim_time` is due. Only while not paused.
  time::Nanoseconds deadline(time::Nanoseconds sim_time) const {
    return anchor_monotonic_ + scaled(sim_time - anchor_sim_, 1.0 / rate_);
  }

  /// The sim time at `monotonic`.
  time::Nanoseconds sim_time(time::Nanoseconds monotonic) const {
    return paused_ ? anchor_sim_ : anchor_sim_ + scaled(monotonic - anchor_monotonic_, rate_);
  }

  /// Sim time stands still from `monotonic` on.
  void pause(time::Nanoseconds monotonic) {
    anchor(monotonic);
    paused_ = true;
  }
  /// Sim time goes on at `monotonic` from where it stood.
  void resume(time::Nanoseconds monotonic) {
    anchor(monotonic);
    paused_ = false;
  }
  /// From `monotonic` on, another rate.
  void set_rate(time::Nanoseconds monotonic, double rate) {
    anchor(monotonic);
    rate_ = rate;
  }

  double rate() const { return rate_; }
  bool paused() const { return paused_; }

 private:
  void anchor(time::Nanoseconds monotonic) {
    anchor_sim_ = sim_time(monotonic);
    anchor_monotonic_ = monotonic;
  }
  /// Exact at rate 1: only then must a deadline after a week still be right to the nanosecond.
  static time::Nanoseconds scaled(time::Nanoseconds span, double factor) {
    if (factor == 1.0) return span;
    return time::Nanoseconds(static_cast<std::int64_t>(static_cast<double>(span.count()) * factor));
  }

  time::Nanoseconds anchor_monotonic_;
  time::Nanoseconds anchor_sim_{0};
  double rate_;
  bool paused_ = false;
};

}  // namespace inslab::sim
