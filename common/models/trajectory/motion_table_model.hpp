#pragma once

#include "inslab/foundation/time/grid.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/models/trajectory/vehicle_motion.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::trajectory {

/// The truth of a motion table.
///
/// The truth does not depend on the grid: two rates agree on common instants to rounding. After the last segment the
/// vehicle goes on with constant velocity and attitude for as long as it is asked.
class MotionTableModel final : public TruthModel {
 public:
  /// Throws std::invalid_argument, naming the JSON path, when the trajectory breaks a rule of scenario::violation(),
  /// and std::domain_error when the start lies outside the valid domain (nav::check_domain) or begins a ballistic
  /// segment too slowly (VehicleMotion::begin).
  MotionTableModel(const scenario::Trajectory& trajectory, const nav::Gravity& gravity, const time::Grid& grid,
                   const time::GpsTime& start);
  /// In the trajectory's own gravity where that does not vary with place.
  MotionTableModel(const scenario::Trajectory& trajectory, const time::Grid& grid, const time::GpsTime& start);

  /// `segment_index` is that of the segment that begins at or contains the instant, and the number of segments after
  /// the last. `rate_jump` tells of jumps at the instant itself; one inside the interval is part of the increments.
  TruthState current() const override;

  TruthState advance() override;

  /// That of a last segment which ends the run, once it has begun.
  time::Nanoseconds end() const override { return end_; }

 private:
  void integrate_to(time::Nanoseconds end);
  bool begin_segment();
  void advance_to(time::Nanoseconds end);
  template <class Action>
  void located(Action action);

  scenario::Trajectory trajectory_;
  time::Grid grid_;
  time::GpsTime start_;
  VehicleMotion vehicle_;
  std::uint64_t sample_ = 0;
  time::Nanoseconds now_{0};
  time::Nanoseconds interval_{0};  ///< that ends now
  time::Nanoseconds segment_start_{0};
  std::size_t segment_ = 0;
  std::size_t joint_ = 0;  ///< next joint of the segment
  time::Nanoseconds end_ = time::Nanoseconds::max();
  Increments increments_;
  bool rate_jump_ = false;
};

}  // namespace inslab::trajectory
