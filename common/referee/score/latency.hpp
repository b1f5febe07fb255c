#pragma once

#include <deque>
#include <string>

#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/referee/score/quantiles.hpp"

namespace inslab::score {

/// How long an app takes: from the publish time of an IMU sample to the reception of the solution that names it as its
/// newest, both by CLOCK_REALTIME of their hosts.
class Latency {
 public:
  struct Sent {
    std::uint64_t sequence;
    std::int64_t sim_time_ns;
    std::int64_t publish_realtime_ns;
  };

  void add(const ImuSample& imu);

  /// The IMU sample that a solution names; null when it is not there. Apps that do not fill the field in say 0.
  const Sent* named_by(const NavSolution& solution) const;

  /// A solution that names `sample` came. A time of 0 is unknown.
  void note(const Sent& sample, std::int64_t received_realtime_ns);

  /// There is nothing to judge, for this reason ("the run was in lockstep").
  void none_because(const std::string& why) { why_none_ = why; }

  const Quantiles& seconds() const { return seconds_; }
  std::uint64_t negative() const { return negative_; }       ///< hosts whose clocks do not agree
  const std::string& why_none() const { return why_none_; }  ///< empty: there may be one

 private:
  std::deque<Sent> sent_;
  Quantiles seconds_;
  std::uint64_t negative_ = 0;
  std::string why_none_;
};

/// What Latency::none_because() is told of a run in lockstep.
inline constexpr const char* kLockstepHasNoLatency = "the run was in lockstep, where the clock waits for the app";

}  // namespace inslab::score
