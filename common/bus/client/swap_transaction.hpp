#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/client/run_link.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::client {

/// How long to wait for acknowledgements: so many seconds in all when they are given, else as long as the run goes on
/// and a while beyond its last word, since a swap in the future is acknowledged by its first sample. Times are those of
/// CLOCK_MONOTONIC.
class Patience {
 public:
  Patience(std::optional<double> timeout_s, time::Nanoseconds now);

  time::Nanoseconds end() const { return end_; }
  bool is_over(time::Nanoseconds now) const { return now > end_; }

  /// What has come of the run by now.
  void hear(const RunLink& link, time::Nanoseconds now);

 private:
  bool limited_;
  bool ended_ = false;
  time::Nanoseconds end_;
  std::uint64_t statuses_ = 0;
  RunId run_id_;  ///< the run that is waited for
};

/// How a transaction waits; a test has a clock of its own.
struct Pace {
  std::function<time::Nanoseconds()> now;  ///< CLOCK_MONOTONIC
  std::function<void()> rest;              ///< some milliseconds
  std::function<bool()> interrupted;
};

/// That of this process, which a signal interrupts.
Pace pace_of_this_process();

/// What became of a list of swaps.
struct SwapsPlayed {
  bool in_effect = false;  ///< each of them
  std::string failure;     ///< why the transaction ended before the last answer; empty: it did not
};

/// Sends swaps to a running set and waits for what becomes of each; `told` hears each answer as it comes, in the order
/// of the swaps. `where` names the place in which a trajectory server is looked for.
SwapsPlayed play_swaps(RunLink& link, const std::vector<catalog::AnyProfile>& swaps, std::optional<double> timeout_s,
                       const std::string& where, const std::function<void(const ProfileAck&)>& told,
                       const Pace& pace = pace_of_this_process());

/// Whether the swap is in effect.
bool is_in_effect(const ProfileAck& ack);

/// "rejected: /gyro/...: is ...", "applied at 20.000000000 s; first sample under it ..."
std::string words_of(const ProfileAck& ack);

}  // namespace inslab::client
