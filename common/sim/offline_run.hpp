#pragma once

#include <functional>
#include <vector>

#include "inslab/models/navigation/navigator.hpp"
#include "inslab/sim/run_sink.hpp"
#include "inslab/sim/sensors.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::sim {

/// The models of all services in one process, without DDS, as fast as they go. For the same scenario and seed its
/// samples are those of the live run, bit for bit (run id and publish times aside).
class OfflineRun {
 public:
  /// Journals the scenario's schedule of swaps at once; an entry that the journal rejects goes to `sink` as an ack.
  /// A live vehicle's motion is what `vehicle_states` says, those that a live run used, in their order.
  OfflineRun(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id, RunSink& sink,
             std::vector<UsedVehicleState> vehicle_states = {});

  /// One truth sample and what follows from it; false when none is left. Throws std::domain_error when the vehicle
  /// leaves the valid domain, std::runtime_error when the states of a live vehicle do not belong to the scenario or end
  /// before it.
  bool step();

  /// From here on without the reference navigation app, and of the sensors with those of the kinds `Kept` alone.
  template <class... Kept>
  void keep_only() {
    navigator_.reset();
    for_each(catalog::SensorKinds{}, [&](auto tag) {
      using Kind = typename decltype(tag)::type;
      if constexpr (!is_among<Kind, Types<Kept...>>) sensors<Kind>().clear();
    });
  }

  time::Nanoseconds sim_time() const { return sim_time_; }
  /// The reference navigation app; null when the scenario has none.
  navigation::Navigator* navigator() { return navigator_ ? &*navigator_ : nullptr; }

 private:
  template <class Kind>
  auto& sensors() {
    return std::get<Sensors<Kind>>(sensors_);
  }
  template <class Kind>
  void process(const TruthState& truth);
  void use_vehicle_states();
  void navigate(std::int64_t fixes_complete_up_to_ns);

  RunSink& sink_;
  RunId run_id_;
  TruthSource source_;
  template <class Kind>
  using Sensors = std::vector<Sensor<Kind>>;
  Applied<std::tuple, Mapped<Sensors, catalog::SensorKinds>> sensors_;
  std::optional<scenario::ReferenceNav> app_;  ///< whose sensors the navigation app hears
  std::optional<navigation::Navigator> navigator_;
  std::vector<UsedVehicleState> vehicle_states_;
  std::size_t next_vehicle_state_ = 0;
  time::Nanoseconds sim_time_{0};
};

}  // namespace inslab::sim
