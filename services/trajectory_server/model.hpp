#pragma once

#include "samples/truth_state.hpp"
#include "scenario/trajectory.hpp"
#include "services/trajectory_server/vehicle_motion.hpp"
#include "time/rate.hpp"

namespace inslab::trajectory {

/// The truth of a scenario on the grid t_k = k/rate: what the vehicle does, and what a perfect IMU at its reference
/// point would measure. Knows no clock and no bus; the same scenario gives the same bits.
///
/// The truth does not depend on the grid: two rates agree on common instants to rounding. After the last segment the
/// vehicle goes on with constant velocity and attitude for as long as it is asked.
class TrajectoryModel {
 public:
  /// Throws std::invalid_argument, naming the JSON path, when the trajectory breaks a rule of scenario::violation(),
  /// and std::domain_error when the start lies outside the valid domain (nav::check_domain).
  TrajectoryModel(const scenario::Trajectory& trajectory, const time::Rate& truth_rate, const time::GpsTime& start);

  /// The newest sample; the start, with no interval, until the first advance(). Run id, publish times and
  /// journal_in_effect are the publisher's and stay 0.
  ///
  /// `segment_index` is that of the segment that begins at or contains the instant, and the number of segments after
  /// the last. `rate_jump` tells of jumps at the instant itself; one inside the interval is part of the increments.
  TruthState current() const;

  /// Goes to the next instant of the grid and returns it. Throws std::domain_error, naming time, segment, quantity and
  /// limits, when the vehicle leaves the valid domain there; the model is then of no more use.
  TruthState advance();

 private:
  void integrate_to(time::Nanoseconds end);
  bool begin_segment();
  void require_domain() const;

  scenario::Trajectory trajectory_;
  time::Rate rate_;
  time::GpsTime start_;
  VehicleMotion vehicle_;
  std::uint64_t sample_ = 0;
  time::Nanoseconds now_{0};
  time::Nanoseconds segment_start_{0};
  std::size_t segment_ = 0;
  std::size_t joint_ = 0;  ///< next joint of the segment
  Increments increments_;
  bool rate_jump_ = false;
};

}  // namespace inslab::trajectory
