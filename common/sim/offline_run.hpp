#pragma once

#include <functional>
#include <vector>

#include "inslab/models/navigation/navigator.hpp"
#include "inslab/sim/emulator.hpp"
#include "inslab/sim/injector.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::cli {

/// Where the samples of an offline run go; every function is called in the order of sim time.
class RunSink {
 public:
  virtual ~RunSink() = default;
  virtual void journal(const AnyProfile& entry) = 0;
  virtual void vehicle_state(const UsedVehicleState&) {}  ///< of a live vehicle only
  virtual void truth(const TruthState& truth) = 0;
  virtual void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) = 0;
  virtual void gnss(std::size_t index, const GnssFix& fix) = 0;
  virtual void nav(const NavSolution&) {}  ///< of the reference navigation app, when the scenario has it
  virtual void ack(const ProfileAck& ack) = 0;
};

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

  /// From here on without receivers and the reference navigation app.
  void leave_navigation();
  /// From here on without IMUs, and so without all of that.
  void leave_sensors();

  time::Nanoseconds sim_time() const { return sim_time_; }
  /// The reference navigation app; null when the scenario has none.
  reference_nav::Navigator* navigator() { return navigator_ ? &*navigator_ : nullptr; }

 private:
  void use_vehicle_states();
  void navigate(std::int64_t fixes_complete_up_to_ns);

  RunSink& sink_;
  RunId run_id_;
  trajectory::TruthSource source_;
  std::vector<imu::Injector> injectors_;
  std::vector<gnss::Emulator> emulators_;
  std::size_t nav_imu_ = 0;   ///< index of the injector that the navigation app hears
  std::size_t nav_gnss_ = 0;  ///< and of the emulator
  std::optional<reference_nav::Navigator> navigator_;
  std::vector<UsedVehicleState> vehicle_states_;
  std::size_t next_vehicle_state_ = 0;
  time::Nanoseconds sim_time_{0};
};

}  // namespace inslab::cli
