#pragma once

#include <optional>

#include "inslab/data/samples/service_status.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::sim {

/// What a trajectory server, the only one of its unit, hears of other runs before its own begins. Knows no bus and no
/// clock.
class OtherRuns {
 public:
  explicit OtherRuns(const RunId& own) : own_(own) {}

  /// A heartbeat of any service, at `now`.
  void hear(const ServiceStatus& status, time::Nanoseconds now);

  /// A service in a run whose server is gone: it stays in that run although this server is the only one.
  const ServiceStatus* orphan(time::Nanoseconds now) const;

 private:
  RunId own_;
  std::optional<ServiceStatus> running_;
  time::Nanoseconds running_since_{0};  ///< when it was heard first
};

}  // namespace inslab::sim
