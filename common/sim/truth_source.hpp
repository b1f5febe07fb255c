#pragma once

#include <variant>

#include "inslab/models/trajectory/live_vehicle_model.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/sim/journal.hpp"

namespace inslab::sim {

/// The truth of a run together with its journal: what the trajectory server sends, without bus and clock. The live
/// server and the one-process runner drive the same class.
class TruthSource {
 public:
  /// The scenario must live as long.
  TruthSource(const scenario::LoadedScenario& scenario, const time::GpsTime& start, const RunId& run_id);

  /// Judges a request; see sim::Journal::submit.
  std::variant<catalog::AnyProfile, ProfileAck> submit(const catalog::AnyProfile& request);

  /// Takes a state of a live vehicle into account from the next sample on. Nothing when it is of no use: see
  /// LiveVehicleModel::receive(). Throws std::logic_error when the scenario has no live vehicle.
  std::optional<UsedVehicleState> receive(const VehicleState& state);
  /// How well the states came; null when the scenario has no live vehicle.
  const VehicleLink* vehicle_link() const { return live_vehicle_ == nullptr ? nullptr : &live_vehicle_->link(); }

  /// Whether a sample is left: the scenario's duration is not over, nor has the motion ended itself.
  bool has_next() const { return taken_ < samples_ && next_time() <= model_->end(); }
  /// Sim time of the sample that take() gives next.
  time::Nanoseconds next_time() const { return next_time_; }
  /// The next sample; requests submitted before this call can be in effect for it. Throws std::domain_error when the
  /// vehicle leaves the valid domain.
  TruthState take();
  /// Computes the sample after the one taken last, so that take() costs nothing at its deadline. take() does it when
  /// it was not called. Does nothing for a live vehicle, whose states may come until the deadline.
  void prepare();

  /// Whether a swap takes effect right after the sample of this time.
  bool is_swap_time(time::Nanoseconds t) const { return journal_.applies_at(t); }

  std::uint64_t taken() const { return taken_; }
  std::uint32_t journal_size() const { return journal_.size(); }

 private:
  void compute_next();

  RunId run_id_;
  time::Grid grid_;
  std::uint64_t samples_;
  time::GpsTime start_;
  std::unique_ptr<trajectory::TruthModel> model_;
  trajectory::LiveVehicleModel* live_vehicle_;  ///< model_, when it is one
  Journal journal_;
  const scenario::LoadedScenario& scenario_;
  TruthState next_;
  bool prepared_ = true;
  std::uint64_t taken_ = 0;
  time::Nanoseconds next_time_{0};
  time::Nanoseconds last_time_{0};  ///< of the sample taken last; 0 before the first
};

}  // namespace inslab::sim
