#pragma once

#include <map>
#include <optional>

#include "samples/run_control.hpp"
#include "samples/service_status.hpp"
#include "time/gps_time.hpp"

namespace inslab::trajectory {

/// What a trajectory server hears of other runs of its unit before its own begins. A unit has one trajectory server,
/// and a run has one from its start to its end. Knows no bus and no clock.
class OtherRuns {
 public:
  explicit OtherRuns(const RunId& own) : own_(own) {}

  /// A status of any run.
  void hear(const SimStatus& status);
  /// A heartbeat of any service, at `now`.
  void hear(const ServiceStatus& status, time::Nanoseconds now);

  /// Another server that is at work; of two that wait both, the one with the smaller run id stays.
  const std::optional<SimStatus>& server() const { return server_; }
  /// A service in a run whose server is gone: for as long as it takes to hear one that lives it was in that run, and no
  /// server was heard.
  const ServiceStatus* orphan(time::Nanoseconds now) const;

 private:
  RunId own_;
  std::optional<SimStatus> server_;
  std::optional<ServiceStatus> running_;
  time::Nanoseconds running_since_{0};  ///< when it was heard first
};

}  // namespace inslab::trajectory
