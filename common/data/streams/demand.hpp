#pragma once

#include <cstdint>
#include <optional>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::streams {

/// Longer than any wait.
inline constexpr time::Nanoseconds kNever = time::Nanoseconds::max();

/// How a consumer asks its producer for what it lacks.
struct DemandPolicy {
  /// From one word of the consumer to its repetition. While nothing new comes this doubles, up to `longest_repeat`:
  /// sixteen consumers on a busy machine that each have a stream sent again five times a second keep it from coming.
  time::Nanoseconds repeat{0};
  time::Nanoseconds longest_repeat{0};
  /// Nothing after the newest sample would show that it is missing. After so long without one it is asked for.
  time::Nanoseconds silence = kNever;
  /// A sample that is missing for so long will not come.
  time::Nanoseconds patience = kNever;
  bool skips = false;         ///< goes on without what will not come; otherwise there is no going on
  bool keeps_saying = false;  ///< repeats how far it is though it lacks nothing: a credit that got lost must not stop
                              ///< the producer
};

/// Of the truth, which a sensor's model must have whole: a service that lacks a sample of it for eight seconds ends.
DemandPolicy demand_of_truth(ClockMode clock);
/// Of a sensor's stream, as a navigation app takes it: in real time what is late by more than 100 ms is of no use.
DemandPolicy demand_of_input(ClockMode clock);
/// Of whatever the logger writes down. It takes samples as they come and gives none up. Once the run has ended, the
/// others stay until it has everything: it speaks more often, and takes silence for a sign in real time, too.
DemandPolicy demand_of_log(ClockMode clock, bool run_has_ended);

/// What a consumer knows of a stream.
struct Known {
  std::uint64_t next = 0;               ///< the least sample that has not come
  bool newer_came = false;              ///< there is a gap
  bool more_was_sent = false;           ///< the producer has said so
  bool more_may_have_been_sent = true;  ///< silence may mean that the newest got lost
  bool moved = false;                   ///< the consumer is further than it has said; the producer waits for that
};

/// What a consumer says to its producer now.
struct Ask {
  bool resend = false;  ///< and wants what it lacks once more
};

/// When a consumer of a stream speaks: how far it is, what it lacks, and when it gives that up. Knows no bus and no
/// clock; `now` is any clock that only goes forward, and look() is called many times a second.
class Demand {
 public:
  /// Begins with a stream: whatever was sent before is asked for.
  void begin(const DemandPolicy& policy, time::Nanoseconds now);
  /// Another policy for the same stream.
  void change(const DemandPolicy& policy, time::Nanoseconds now);
  /// A sample that was not there before.
  void came(time::Nanoseconds now);
  /// What is to be said now; nothing when it is not time, or there is nothing to say.
  std::optional<Ask> look(const Known& known, time::Nanoseconds now);
  /// Whether sample `next`, which newer ones have overtaken, will not come any more.
  bool gave_up(std::uint64_t next, time::Nanoseconds now) const;
  const DemandPolicy& policy() const { return policy_; }

 private:
  void forgive_a_standstill(time::Nanoseconds now);
  void watch_the_gap(const Known& known, time::Nanoseconds now);

  struct Gap {
    std::uint64_t at = 0;
    time::Nanoseconds since{0};
  };

  DemandPolicy policy_;
  bool begins_ = false;
  bool was_silent_ = false;
  time::Nanoseconds interval_{0};  ///< to the next repetition but one
  time::Nanoseconds next_at_{0};
  time::Nanoseconds came_at_{0};
  time::Nanoseconds looked_at_{0};
  std::optional<Gap> gap_;
  std::optional<std::uint64_t> asked_from_;  ///< of the gap
};

}  // namespace inslab::streams
