#include "inslab/referee/graft/geometry_fit.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace inslab::graft {
namespace {

constexpr int kGeometry = 7;               ///< time offset, roll, pitch, yaw, arm x, y, z
constexpr int kTerms = kGeometry + 6 + 6;  ///< and bias and scale factor of each axis
using Terms = Eigen::Matrix<double, kTerms, 1>;
using Square = Eigen::Matrix<double, kTerms, kTerms>;
using Series = std::vector<RecordedErrors::Increments>;

double& value(Geometry& geometry, int i) {
  if (i == 0) return geometry.time_offset_s;
  return i < 4 ? geometry.mounting_rpy_rad[i - 1] : geometry.lever_arm_v_m[i - 4];
}

/// Steps of the derivatives: small beside what bends, large beside rounding.
constexpr std::array<double, kGeometry> kSteps{1e-4, 1e-5, 1e-5, 1e-5, 0.1, 0.1, 0.1};
/// The iterations end with changes of less than this part of each standard deviation.
constexpr double kSettled = 0.01;

struct Residuals {
  double gyro_variance = 0.0;
  double accel_variance = 0.0;
};

/// Normal equations of all intervals, each triad weighed by what its residuals spread.
struct Normal {
  Square square = Square::Zero();
  Terms right = Terms::Zero();
};

Normal normal_equations(const Series& measured, const Series& modelled, const std::array<Series, kGeometry>& changed,
                        double dt_s, const Residuals& spread) {
  Normal normal;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
      Terms row = Terms::Zero();
      for (std::size_t i = 0; i < kGeometry; ++i) {
        row[static_cast<int>(i)] = (changed[i][k][axis] - modelled[k][axis]) / kSteps[i];
      }
      row[kGeometry + static_cast<int>(axis)] = dt_s;
      row[kGeometry + 6 + static_cast<int>(axis)] = modelled[k][axis];
      const double weight = 1.0 / (axis < 3 ? spread.gyro_variance : spread.accel_variance);
      normal.square.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
      normal.right += weight * (measured[k][axis] - modelled[k][axis]) * row;
    }
  }
  normal.square = normal.square.selfadjointView<Eigen::Lower>();
  return normal;
}

/// What the residuals of each triad spread about their means.
Residuals residuals_of(const Series& measured, const Series& modelled) {
  std::array<double, RecordedErrors::kAxes> sum{}, squares{};
  for (std::size_t k = 0; k < measured.size(); ++k) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
      const double off = measured[k][axis] - modelled[k][axis];
      sum[axis] += off;
      squares[axis] += off * off;
    }
  }
  const auto count = static_cast<double>(measured.size());
  const auto triad = [&](std::size_t first) {
    double variance = 0.0;
    for (std::size_t axis = first; axis < first + 3; ++axis) {
      variance += (squares[axis] - sum[axis] * sum[axis] / count) / count / 3.0;
    }
    return std::max(variance, std::numeric_limits<double>::min());
  };
  return {triad(0), triad(3)};
}

/// What is known of each term without any data: standard deviations about the start, about zero for bias (rad/s, m/s^2)
/// and scale factor. Wide beside what any motion tells; what it tells nothing of stays where it began.
Terms prior_sigma() {
  Terms sigma;
  sigma << 1.0, 0.3, 0.3, 0.3, 10.0, 10.0, 10.0,  //
      0.1, 0.1, 0.1, 1.0, 1.0, 1.0,               //
      0.1, 0.1, 0.1, 0.1, 0.1, 0.1;
  return sigma;
}

struct Solution {
  Terms change;
  Terms sigma;
};

/// `off` is how far each term is from what is known of it beforehand.
Solution solved(const Normal& normal, const Terms& off) {
  const Terms information = prior_sigma().cwiseAbs2().cwiseInverse();
  Square square = normal.square;
  square.diagonal() += information;
  const Terms scale = square.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<Square> factors(scale.asDiagonal() * square * scale.asDiagonal());
  const Terms right = normal.right - information.cwiseProduct(off);
  Solution solution;
  solution.change = scale.cwiseProduct(factors.solve(scale.cwiseProduct(right)));
  const Square covariance = factors.solve(Square::Identity());
  solution.sigma = scale.cwiseProduct(covariance.diagonal().cwiseSqrt());
  return solution;
}

}  // namespace

GeometryFit fit_geometry(const ReferenceImu& reference, const Series& measured, const Geometry& start) {
  constexpr int kMostIterations = 20;
  GeometryFit fit;
  fit.geometry = start;
  const double dt_s = reference.rate().period_s();
  for (fit.iterations = 1; fit.iterations <= kMostIterations; ++fit.iterations) {
    const Series modelled = reference.increments(fit.geometry);
    std::array<Series, kGeometry> changed;
    for (int i = 0; i < kGeometry; ++i) {
      Geometry beside = fit.geometry;
      value(beside, i) += kSteps[static_cast<std::size_t>(i)];
      changed[static_cast<std::size_t>(i)] = reference.increments(beside);
    }
    Terms off = Terms::Zero();
    Geometry begun = start;
    for (int i = 0; i < kGeometry; ++i) off[i] = value(fit.geometry, i) - value(begun, i);
    const Solution solution =
        solved(normal_equations(measured, modelled, changed, dt_s, residuals_of(measured, modelled)), off);
    bool has_settled = true;
    for (int i = 0; i < kGeometry; ++i) {
      value(fit.geometry, i) += solution.change[i];
      value(fit.sigma, i) = solution.sigma[i];
      has_settled = has_settled && std::abs(solution.change[i]) < kSettled * solution.sigma[i];
    }
    if (has_settled) return fit;
  }
  throw std::runtime_error(
      "time offset, mounting and lever arm do not settle; begin nearer with --time-offset, "
      "--mounting and --lever-arm");
}

}  // namespace inslab::graft
