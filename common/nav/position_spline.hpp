#pragma once

#include <optional>
#include <vector>

#include "inslab/nav/geodesy.hpp"

namespace inslab::nav {

/// One cubic of a curve over the Earth. Frame k: north, east, down at the piece's origin, fixed to the Earth.
struct PositionPiece {
  Geodetic origin;                 ///< at parameter 0
  Vector3 c1_k = Vector3::Zero();  ///< m per unit of the parameter
  Vector3 c2_k = Vector3::Zero();
  Vector3 c3_k = Vector3::Zero();

  /// Displacement from the origin, m, and its first two derivatives by the parameter.
  Vector3 displacement_k(double u) const { return u * (c1_k + u * (c2_k + u * c3_k)); }
  Vector3 first_k(double u) const { return c1_k + u * (2.0 * c2_k + u * (3.0 * c3_k)); }
  Vector3 second_k(double u) const { return 2.0 * c2_k + u * (6.0 * c3_k); }
};

/// A twice continuously differentiable curve through points on the Earth: a cubic spline in e over any parameter (time,
/// or length).
///
/// Every piece is a displacement from its own first point, and the spline is found from the differences of neighbours
/// (ned_from), so nothing cancels however far the points lead, and no meridian is special. Neighbours are at most
/// 1000 km apart; between far ones the curve is the chord's, below the ground.
class PositionSpline {
 public:
  /// Derivative by the parameter at an end, in e; where it is absent the end piece is a parabola.
  struct Ends {
    std::optional<Vector3> first_e;
    std::optional<Vector3> last_e;
  };

  /// `intervals` are the parameter's steps from point to point, above 0: one less than there are points, of which there
  /// are at least two. Throws std::invalid_argument otherwise. Time and memory are linear in the points.
  PositionSpline(std::vector<Geodetic> points, std::vector<double> intervals, const Ends& ends);

  std::size_t pieces() const { return intervals_.size(); }
  double interval(std::size_t piece) const { return intervals_[piece]; }
  const Geodetic& point(std::size_t index) const { return points_[index]; }

  /// The derivative at a point, in e.
  const Vector3& slope_e(std::size_t index) const { return slopes_e_[index]; }

  /// The piece from point(index) to point(index + 1); its parameter runs from 0 to interval(index).
  PositionPiece piece(std::size_t index) const;

 private:
  std::vector<Geodetic> points_;
  std::vector<double> intervals_;
  std::vector<Vector3> slopes_e_;
};

}  // namespace inslab::nav
