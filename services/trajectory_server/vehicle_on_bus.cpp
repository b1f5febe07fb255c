#include "inslab/services/trajectory_server/vehicle_on_bus.hpp"

#include <spdlog/spdlog.h>

#include "inslab/data/streams/stamp.hpp"
#include "inslab/foundation/host/host.hpp"

namespace inslab::trajectory_server {

VehicleOnBus::VehicleOnBus(service::Context& context, const scenario::LiveVehicle& options,
                           std::function<void(const VehicleState&)> put)
    : used_(context.participant(), dds::topics::vehicle_state_used(options.nominal_rate_hz)),
      link_(context.participant(), dds::topics::vehicle_link()),
      states_(context.participant(), dds::topics::vehicle_state(options.nominal_rate_hz),
              context.writers().only_the_app(
                  dds::topics::vehicle_state().name, false,
                  [put = std::move(put)](const VehicleState& state, const dds::SampleOrigin&) { put(state); })) {}

void VehicleOnBus::take(const VehicleState& state, sim::TruthSource& source) {
  const std::uint64_t refused = source.vehicle_link()->refused;
  if (auto used = source.receive(state)) {
    used_.write(streams::stamped(*used));
    return;
  }
  if (source.vehicle_link()->refused == refused) return;
  if (host::monotonic_now() - last_warning_ < std::chrono::seconds(1)) return;
  last_warning_ = host::monotonic_now();
  spdlog::warn("state {} of the vehicle refused: {}", state.sequence_number, source.vehicle_link()->last_refusal);
}

void VehicleOnBus::report(const sim::TruthSource& source, const RunId& run_id, std::int64_t sim_time_ns) {
  VehicleLink link = *source.vehicle_link();
  link.run_id = run_id;
  link.sim_time_ns = sim_time_ns;
  link_.write(link);
}

void VehicleOnBus::fill(ServiceStatus& status, const VehicleLink& link) const {
  StreamStatus in;
  in.topic = dds::topics::vehicle_state().name;
  in.direction = StreamDirection::In;
  in.samples = link.received;
  in.lost = link.missing;
  in.out_of_order = link.not_newer;
  status.streams.push_back(in);
  StreamStatus out;
  out.topic = dds::topics::vehicle_state_used().name;
  out.direction = StreamDirection::Out;
  out.samples = link.used;
  status.streams.push_back(out);
}

bool VehicleOnBus::flush(std::chrono::nanoseconds timeout) {
  return used_.wait_for_acknowledgments(timeout) && link_.wait_for_acknowledgments(timeout);
}

}  // namespace inslab::trajectory_server
