#include "inslab/nav/position_spline.hpp"

#include <stdexcept>
#include <utility>

#include "inslab/nav/cubic_spline.hpp"

namespace inslab::nav {

namespace {

Matrix3 C_en_at(const Geodetic& point) { return C_en(point.latitude_rad, point.longitude_rad); }

/// The chords over their intervals, in e.
std::vector<Vector3> chord_slopes(const std::vector<Geodetic>& points, const std::vector<double>& intervals) {
  std::vector<Vector3> slopes(intervals.size());
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    slopes[k] = C_en_at(points[k]) * ned_from(points[k], points[k + 1]) / intervals[k];
  }
  return slopes;
}

}  // namespace

PositionSpline::PositionSpline(std::vector<Geodetic> points, std::vector<double> intervals, const Ends& ends)
    : points_(std::move(points)), intervals_(std::move(intervals)) {
  if (points_.size() < 2 || points_.size() != intervals_.size() + 1) {
    throw std::invalid_argument("a curve has at least two points and an interval between each and the next");
  }
  for (const double interval : intervals_) {
    if (!(interval > 0.0)) throw std::invalid_argument("an interval of a curve is not above 0");
  }
  slopes_e_ = cubic_spline_slopes(intervals_, chord_slopes(points_, intervals_), ends.first_e, ends.last_e);
}

PositionPiece PositionSpline::piece(std::size_t index) const {
  const Geodetic& origin = points_[index];
  const double h = intervals_[index];
  const Matrix3 C_ke = C_en_at(origin).transpose();
  const Vector3 m0 = C_ke * slopes_e_[index], m1 = C_ke * slopes_e_[index + 1];
  const Vector3 D = ned_from(origin, points_[index + 1]) / h;
  return {origin, m0, (3.0 * D - 2.0 * m0 - m1) / h, (m0 + m1 - 2.0 * D) / (h * h)};
}

}  // namespace inslab::nav
