#pragma once

#include <deque>
#include <optional>

#include "inslab/data/samples/vehicle_state.hpp"
#include "inslab/foundation/time/grid.hpp"
#include "inslab/models/trajectory/live_path.hpp"
#include "inslab/models/trajectory/truth_model.hpp"
#include "inslab/models/trajectory/vehicle_motion.hpp"
#include "inslab/nav/gravity.hpp"
#include "inslab/scenario/trajectory.hpp"

namespace inslab::trajectory {

/// The truth of a vehicle that is simulated elsewhere: a smooth curve through the states that were received.
///
///   truth(t) = vehicle(t - latency)
///
/// Between two states the curve is a polynomial through them (LivePathPiece::between). Where the next state has not
/// come in time it goes on with fading acceleration (LivePathPiece::beyond), and once one comes, what has gone wrong
/// meanwhile is led back over the return time (LivePathOffset): position, velocity and attitude never jump, nor do
/// acceleration and rate. Position, velocity, rate, specific force and the increments are those of the same curve. Its
/// velocity and attitude are those of the states; its position differs by what the states' own velocities and positions
/// contradict each other, as far as that is not led back yet.
///
/// A pure function of the scenario and of which states were received before which advance(): the run that is given them
/// again has the same bits. Source: docs/models.md, "Live vehicle".
class LiveVehicleModel final : public TruthModel {
 public:
  /// Throws std::invalid_argument when the trajectory breaks a rule of scenario::violation(), std::domain_error when
  /// its initial state lies outside the valid domain.
  LiveVehicleModel(const scenario::Trajectory& trajectory, const nav::Gravity& gravity, const time::Grid& grid,
                   const time::GpsTime& start);

  /// Takes a state into account from the next advance() on; false when it is of no use, which link() says, and changes
  /// nothing else then: it is not finite, outside the limits of VehicleState or of the domain, no rotation, further
  /// than the jump limit from where the last one leads, more than a second ahead, or no newer than the last one.
  bool receive(const VehicleState& state);

  /// The counts so far; run id and time are the publisher's.
  const VehicleLink& link() const { return link_; }

  TruthState current() const override;

  /// As TruthModel::advance(); throws std::runtime_error, naming the limit, when states have stayed out for too long.
  TruthState advance() override;

 private:
  struct Instant;

  TruthState advanced();

  std::optional<std::string> reason_to_refuse(const VehicleState& state) const;
  VehicleKnot knot_of(const VehicleState& state) const;
  void count(const VehicleKnot& knot);
  void begin_next_piece();
  void drop_passed();
  void require_fresh(time::Nanoseconds instant) const;
  void integrate_to(time::Nanoseconds end);
  LivePathPoint path_point(double since_piece_s) const;
  Instant at(double since_piece_s) const;
  bool is_extrapolating() const { return piece_end_ == time::Nanoseconds::max(); }

  scenario::LiveVehicle options_;
  time::Nanoseconds latency_;
  time::Nanoseconds extrapolation_limit_;
  time::Grid grid_;
  time::GpsTime start_;
  nav::Gravity gravity_;

  VehicleKnot newest_;                ///< the last state received
  std::deque<VehicleKnot> upcoming_;  ///< received, and not yet an end of piece_
  VehicleKnot base_;                  ///< where piece_ ends, or what it extrapolates
  LivePathPiece piece_;
  time::Nanoseconds piece_end_;  ///< max(): extrapolating, without end
  LivePathOffset offset_;

  std::uint64_t sample_ = 0;
  time::Nanoseconds now_{0};
  time::Nanoseconds interval_{0};  ///< that ends now
  Increments increments_;
  VehicleLink link_;
};

}  // namespace inslab::trajectory
