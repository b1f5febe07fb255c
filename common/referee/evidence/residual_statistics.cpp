#include "inslab/referee/evidence/residual_statistics.hpp"

#include <cmath>

namespace inslab::evidence {

double ResidualStatistics::pooled_sigma() const {
  // Regressors differ by ten decades (seconds, rad/s): each to length 1 first. One that never changed explains
  // nothing.
  Regressors scale = xx_.diagonal().cwiseSqrt();
  for (double& s : scale) s = s > 0.0 ? 1.0 / s : 0.0;
  Square square = scale.asDiagonal() * xx_ * scale.asDiagonal();
  Cross cross = scale.asDiagonal() * xy_;
  // Regressors are taken out one after the other, the longest first; one that is all but a sum of those before it is
  // none (Cholesky's elimination with pivots: quicker to build than a decomposition of Eigen's).
  constexpr double kShortest = 1e-10;
  Vector3 left = yy_;
  int rank = 0;
  for (; rank < kRegressors; ++rank) {
    Eigen::Index longest = 0;
    const double length = square.diagonal().maxCoeff(&longest);
    if (!(length > kShortest)) break;
    const Regressors along = square.col(longest);
    const Vector3 explained = cross.row(longest);
    left -= explained.cwiseAbs2() / length;
    square -= along * (along / length).transpose();
    cross -= along * (explained / length).transpose();
    square(longest, longest) = 0.0;  // not by rounding
  }
  const double freedom = static_cast<double>(count_) - static_cast<double>(rank);
  return std::sqrt(left.cwiseMax(0.0).mean() / freedom);
}

}  // namespace inslab::evidence
