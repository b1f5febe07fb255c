#pragma once

#include <functional>

#include "dds/writer.hpp"
#include "samples/service_status.hpp"
#include "time/gps_time.hpp"

namespace inslab::app {

/// The heartbeat of a service: says once a second, and at every change of state, how it is.
class StatusBoard {
 public:
  /// `fill` adds the counters just before each report.
  StatusBoard(dds::Participant& participant, std::string service, std::uint32_t sensor_number,
              std::function<void(ServiceStatus&)> fill);

  /// Reports when a second has passed since the last report. Cheap otherwise.
  void tick();

  /// Changes the state and reports it, unless it is that state already.
  void enter(ServiceState state, const std::string& message = {});

  ServiceState state() const { return status_.state; }
  void set_run(const RunId& run_id) { status_.run_id = run_id; }
  void set_sim_time(std::int64_t sim_time_ns) { status_.sim_time_ns = sim_time_ns; }

  /// Waits until every reader has the last report; false after the timeout.
  bool flush(std::chrono::nanoseconds timeout) { return writer_.wait_for_acknowledgments(timeout); }

 private:
  void report();

  dds::Participant& participant_;
  ServiceStatus status_;
  std::function<void(ServiceStatus&)> fill_;
  time::Nanoseconds last_report_{0};
  dds::Writer<ServiceStatus> writer_;
};

}  // namespace inslab::app
