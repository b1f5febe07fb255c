#pragma once

#include <vector>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/referee/verify/reference_earth.hpp"

namespace inslab::verify {

/// The cubic spline over time through a file's positions, in e and in extended precision: solved for the second
/// derivatives at the rows, where the product solves for slopes piece by piece in local frames. A cubic spline does not
/// depend on the frame, so both are one curve. The first and the last row's velocities are its slopes there; without
/// one the end piece is a parabola.
class RowSpline {
 public:
  /// At least three rows, or two with a velocity.
  explicit RowSpline(const TrajectoryFile& file);

  /// Displacement from row k at `u_s` of the piece that begins there, m in e.
  RealVector displacement_e_m(std::size_t k, Real u_s) const;

  /// How far the curve may leave the straight lines between the rows, by the rows alone: the equations for the second
  /// derivatives are dominated by their diagonal, so the largest of these is at most that of the right-hand sides, and
  /// a cubic leaves its chord by an eighth of the interval squared times the larger at its ends.
  Real largest_swing_m() const { return largest_swing_m_; }

 private:
  std::vector<RealVector> rows_e_m_;
  std::vector<Real> intervals_s_;
  std::vector<RealVector> second_e_;  ///< m/s^2 at the rows
  Real largest_swing_m_ = 0;
};

}  // namespace inslab::verify
