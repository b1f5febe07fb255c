#pragma once

#include <functional>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::trajectory_server {

/// The topics of a live vehicle: its states come in, those that the truth was made from and how well they came go out.
class VehicleOnBus {
 public:
  /// `put` hands a state to the worker; it is called by a thread of DDS.
  VehicleOnBus(service::Context& context, const scenario::LiveVehicle& options,
               std::function<void(const VehicleState&)> put);

  /// Whether anybody is there who writes states.
  bool connected() const { return states_.matched_writers() > 0; }

  /// Gives a state to the truth, and says so when it is used. A reason to refuse is logged when it is the first of its
  /// kind within a second.
  void take(const VehicleState& state, sim::TruthSource& source);

  /// Latched, and at the end of the run once more.
  void report(const sim::TruthSource& source, const RunId& run_id, std::int64_t sim_time_ns);

  /// The streams in the heartbeat.
  void fill(ServiceStatus& status, const VehicleLink& link) const;

  /// Waits until every reader has what was sent; false after the timeout.
  bool flush(std::chrono::nanoseconds timeout);

 private:
  dds::Writer<UsedVehicleState> used_;
  dds::Writer<VehicleLink> link_;
  time::Nanoseconds last_warning_{0};
  dds::OpenReader<VehicleState> states_;
};

}  // namespace inslab::trajectory_server
