#pragma once

#include <memory>
#include <vector>

#include "inslab/models/trajectory/heave.hpp"
#include "inslab/nav/rotation_spline.hpp"
#include "inslab/scenario/path_piece.hpp"

/// A motion given as two curves over time: where the vehicle is, and which way it points.
namespace inslab::trajectory {

using scenario::PathPiece;

/// Where the vehicle is over time, twice continuously differentiable: pieces that follow each other from time 0.
class Path {
 public:
  Path() = default;
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;
  virtual ~Path() = default;

  virtual std::size_t pieces() const = 0;
  virtual PathPiece piece(std::size_t index) const = 0;
};

/// q_ev over time, with continuous rate and acceleration: the pieces of a rotation spline on whole nanoseconds.
class AttitudeCurve {
 public:
  /// `q_ev` at `times`, which begin at 0 and increase. Throws as nav::RotationSpline does.
  AttitudeCurve(std::vector<time::Nanoseconds> times, std::vector<nav::Quaternion> q_ev);

  std::size_t pieces() const { return spline_.pieces(); }
  time::Nanoseconds start(std::size_t piece) const { return times_[piece]; }
  time::Nanoseconds end(std::size_t piece) const { return times_[piece + 1]; }
  nav::RotationPiece piece(std::size_t index) const { return spline_.piece(index); }

 private:
  std::vector<time::Nanoseconds> times_;
  nav::RotationSpline spline_;
};

/// Both curves, and how the vehicle heaves about the path. The attitude lasts as long as the path, or beyond the last
/// instant that is asked for.
struct SmoothMotion {
  std::unique_ptr<const Path> path;
  std::unique_ptr<const AttitudeCurve> attitude;
  Heave heave;
};

}  // namespace inslab::trajectory
