#pragma once

#include <functional>

#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::service {

/// The heartbeat of a service: says once a second, and at every change of state, how it is. What was written that must
/// not be (bus/service/writers.hpp) is said at once, and makes a fault of the end.
class StatusBoard {
 public:
  /// `fill` adds the counters just before each report, and may put a message where the state has none.
  StatusBoard(Context& context, std::uint32_t sensor_number, std::function<void(ServiceStatus&)> fill);

  /// Reports when a second has passed since the last report, and says in the log what a start waits for that takes
  /// long. Cheap otherwise.
  void tick();

  /// Changes the state and reports it, unless it is that state already.
  void enter(ServiceState state, const std::string& message = {});

  ServiceState state() const { return state_; }
  void set_run(const RunId& run_id) { status_.run_id = run_id; }
  void set_sim_time(std::int64_t sim_time_ns) { status_.sim_time_ns = sim_time_ns; }

  /// Waits until every reader has the last report; false after the timeout.
  bool flush(std::chrono::nanoseconds timeout) { return writer_.wait_for_acknowledgments(timeout); }

 private:
  void report();

  Context& context_;
  ServiceStatus status_;
  ServiceState state_ = ServiceState::Starting;
  std::string message_;  ///< of the state; `fill` may say more in the report
  std::string fault_;    ///< as it was said last
  std::function<void(ServiceStatus&)> fill_;
  time::Nanoseconds last_report_{0};
  time::Nanoseconds entered_{0};
  bool told_ = true;
  dds::Writer<ServiceStatus> writer_;
};

}  // namespace inslab::service
