#pragma once

#include "inslab/foundation/time/grid.hpp"
#include "inslab/models/trajectory/smooth_vehicle.hpp"
#include "inslab/models/trajectory/truth_model.hpp"

namespace inslab::trajectory {

/// The truth of a motion given as curves: rows of a file in spline mode, or waypoints. It does not depend on the grid:
/// two rates agree on common instants to rounding. `segment_index` counts the rows or waypoints.
class SmoothModel final : public TruthModel {
 public:
  /// `name` says in messages where the motion comes from. Throws std::domain_error as SmoothVehicle does.
  SmoothModel(SmoothMotion motion, std::string name, const nav::Gravity& gravity, const time::Grid& grid,
              const time::GpsTime& start);

  TruthState current() const override;

  /// Throws std::domain_error also when the motion has ended.
  TruthState advance() override;

 private:
  SmoothMotion motion_;
  std::string name_;
  time::Grid grid_;
  time::GpsTime start_;
  SmoothVehicle vehicle_;
  std::uint64_t sample_ = 0;
  time::Nanoseconds interval_{0};  ///< that ends at the instant
};

}  // namespace inslab::trajectory
