#pragma once

#include <memory>

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::trajectory {

/// The truth of a scenario on LoadedScenario::truth_grid(): what the vehicle does, and what a perfect IMU at its
/// reference point would measure. Knows no clock and no bus; the same scenario gives the same bits.
class TruthModel {
 public:
  TruthModel() = default;
  TruthModel(const TruthModel&) = default;
  TruthModel& operator=(const TruthModel&) = default;
  virtual ~TruthModel() = default;

  /// The newest sample; the start, with no interval, until the first advance(). Run id, publish times and
  /// journal_in_effect are the publisher's and stay 0.
  virtual TruthState current() const = 0;

  /// Goes to the next instant of the grid and returns it. Throws std::domain_error, naming time, place in the
  /// trajectory, quantity and limits, when the vehicle leaves the valid domain, and std::runtime_error when what the
  /// motion is made from has ended too soon; the model is then of no more use.
  virtual TruthState advance() = 0;

  /// The instant after which the motion asks for no more samples, once the model has come far enough to know it: the
  /// run ends there, or with the scenario's duration when that is earlier.
  virtual time::Nanoseconds end() const { return time::Nanoseconds::max(); }
};

/// The model that the scenario's trajectory.source asks for. Throws as its constructor does.
std::unique_ptr<TruthModel> make_truth_model(const scenario::LoadedScenario& scenario, const time::GpsTime& start);

}  // namespace inslab::trajectory
