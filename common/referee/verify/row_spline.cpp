#include "inslab/referee/verify/row_spline.hpp"

#include <algorithm>
#include <optional>

namespace inslab::verify {

namespace {

namespace earth = reference_earth;

RealVector position_e_m(const TrajectoryRow& row) {
  return earth::ecef_m(row.position.latitude_rad, row.position.longitude_rad, row.position.height_m);
}

RealVector velocity_e(const TrajectoryRow& row) {
  return earth::C_en(row.position.latitude_rad, row.position.longitude_rad) * row.v_n->cast<Real>();
}

/// below M_(k-1) + 2 M_k + above M_(k+1) = right, with below + above <= 1.
struct Equation {
  Real below = 0, above = 0;
  RealVector right = RealVector::Zero();
};

/// An end with a slope bends by 6 ((chord - slope) / h) / h; one that is a parabola is as bent as its neighbour.
Equation equation_of_end(const std::optional<RealVector>& bend, bool is_first) {
  Equation end;
  (is_first ? end.above : end.below) = bend ? 1 : -2;
  if (bend) end.right = *bend;
  return end;
}

/// Gaussian elimination without exchange of rows.
std::vector<RealVector> solved(const std::vector<Equation>& equations) {
  const std::size_t n = equations.size();
  std::vector<Real> above(n);
  std::vector<RealVector> x(n);
  for (std::size_t k = 0; k < n; ++k) {
    const Equation& e = equations[k];
    const Real pivot = 2 - (k > 0 ? e.below * above[k - 1] : 0);
    above[k] = e.above / pivot;
    x[k] = (e.right - (k > 0 ? RealVector(e.below * x[k - 1]) : RealVector::Zero())) / pivot;
  }
  for (std::size_t k = n - 1; k-- > 0;) x[k] -= above[k] * x[k + 1];
  return x;
}

}  // namespace

RowSpline::RowSpline(const TrajectoryFile& file) {
  const std::size_t n = file.rows.size();
  for (const TrajectoryRow& row : file.rows) rows_e_m_.push_back(position_e_m(row));
  std::vector<RealVector> chords;
  for (std::size_t k = 0; k + 1 < n; ++k) {
    intervals_s_.push_back(static_cast<Real>((file.rows[k + 1].time - file.rows[k].time).count()) / 1e9L);
    chords.push_back((rows_e_m_[k + 1] - rows_e_m_[k]) / intervals_s_[k]);
  }
  std::vector<Equation> equations(n);
  std::optional<RealVector> first, last;
  if (file.rows.front().v_n) first = 6 / intervals_s_.front() * (chords.front() - velocity_e(file.rows.front()));
  if (file.rows.back().v_n) last = 6 / intervals_s_.back() * (velocity_e(file.rows.back()) - chords.back());
  equations.front() = equation_of_end(first, true);
  equations.back() = equation_of_end(last, false);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const Real both = intervals_s_[k - 1] + intervals_s_[k];
    equations[k] = {intervals_s_[k - 1] / both, intervals_s_[k] / both, 6 / both * (chords[k] - chords[k - 1])};
  }
  second_e_ = solved(equations);

  Real largest_right = 0, longest_s = 0;
  for (const Equation& e : equations) largest_right = std::max(largest_right, e.right.norm());
  for (const Real interval_s : intervals_s_) longest_s = std::max(longest_s, interval_s);
  largest_swing_m_ = longest_s * longest_s / 8 * largest_right;
}

RealVector RowSpline::displacement_e_m(std::size_t k, Real u_s) const {
  const Real h = intervals_s_[k];
  const RealVector chord = rows_e_m_[k + 1] - rows_e_m_[k];
  const RealVector slope = chord / h - h / 6 * (2 * second_e_[k] + second_e_[k + 1]);
  return u_s * (slope + u_s * (second_e_[k] / 2 + u_s / (6 * h) * (second_e_[k + 1] - second_e_[k])));
}

}  // namespace inslab::verify
