#include "inslab/referee/graft/motion_terms.hpp"

#include <Eigen/Cholesky>
#include <limits>

#include "inslab/foundation/units/units.hpp"

namespace inslab::graft {
namespace {

using nav::Vector3;

constexpr int kMost = 8;  ///< a constant, three of the triad's own input, and what is its own
using AxisRow = Eigen::Matrix<double, kMost, 1>;
using AxisSquare = Eigen::Matrix<double, kMost, kMost>;

Vector3 rotation_of(const RecordedErrors::Increments& i) { return {i[0], i[1], i[2]}; }
Vector3 velocity_of(const RecordedErrors::Increments& i) { return {i[3], i[4], i[5]}; }

AxisRow gyro_row(const RecordedErrors::Increments& perfect, double dt_s) {
  AxisRow row = AxisRow::Zero();
  row[0] = dt_s;
  row.segment<3>(1) = rotation_of(perfect);
  row.segment<3>(4) = velocity_of(perfect);
  return row;
}

AxisRow accel_row(const RecordedErrors::Increments& perfect, int axis, double dt_s) {
  const Vector3 dv = velocity_of(perfect);
  AxisRow row = AxisRow::Zero();
  row[0] = dt_s;
  row.segment<3>(1) = dv;
  row[4] = dv[axis] * dv[axis] / dt_s;
  return row;
}

/// What such terms can be at most in a sensor worth the name: standard deviations about zero. A term that the motion
/// does not excite stays there instead of following the noise.
constexpr double kScaleFactor = 0.01;
constexpr double kCrossAxisRad = 0.01;
constexpr double kGSensitivity = 100.0 * units::kDegPerH / units::kG;
constexpr double kSquare = 1e-3 / units::kG;
constexpr double kGyroBias = 0.1;   ///< rad/s
constexpr double kAccelBias = 1.0;  ///< m/s^2

AxisRow gyro_prior(int axis) {
  AxisRow sigma = AxisRow::Constant(kCrossAxisRad);
  sigma[0] = kGyroBias;
  sigma[1 + axis] = kScaleFactor;
  sigma.segment<3>(4).setConstant(kGSensitivity);
  return sigma;
}

AxisRow accel_prior(int axis) {
  AxisRow sigma = AxisRow::Constant(kCrossAxisRad);
  sigma[0] = kAccelBias;
  sigma[1 + axis] = kScaleFactor;
  sigma[4] = kSquare;
  return sigma;
}

/// Least squares of one axis with what is known beforehand.
class Regression {
 public:
  void add(const AxisRow& row, double error) {
    square_.selfadjointView<Eigen::Lower>().rankUpdate(row);
    right_ += row * error;
    sum_ += error;
    squares_ += error * error;
    ++count_;
  }
  AxisRow solved(const AxisRow& prior_sigma) const {
    const double noise_variance = std::max(variance(), std::numeric_limits<double>::min());
    AxisSquare square = square_.selfadjointView<Eigen::Lower>();
    square.diagonal() += noise_variance * prior_sigma.cwiseAbs2().cwiseInverse();
    const AxisRow scale = square.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<AxisSquare> factors(scale.asDiagonal() * square * scale.asDiagonal());
    return scale.cwiseProduct(factors.solve(scale.cwiseProduct(right_)));
  }
  /// Share of the variance about the mean that a solution explains.
  double explained(const AxisRow& solution) const {
    const AxisSquare whole = square_.selfadjointView<Eigen::Lower>();
    const double left = squares_ - 2.0 * solution.dot(right_) + solution.dot(whole * solution);
    const double about_mean = variance() * static_cast<double>(count_);
    return about_mean > 0.0 ? std::max(0.0, 1.0 - left / about_mean) : 0.0;
  }

 private:
  double variance() const {
    const auto count = static_cast<double>(count_);
    return std::max(0.0, squares_ - sum_ * sum_ / count) / count;
  }

  AxisSquare square_ = AxisSquare::Zero();
  AxisRow right_ = AxisRow::Zero();
  double sum_ = 0.0;
  double squares_ = 0.0;
  std::size_t count_ = 0;
};

}  // namespace

MotionTerms fit_motion_terms(const std::vector<RecordedErrors::Increments>& errors,
                             const std::vector<RecordedErrors::Increments>& perfect, double dt_s) {
  MotionTerms terms;
  for (int axis = 0; axis < 3; ++axis) {
    Regression gyro, accel;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      gyro.add(gyro_row(perfect[k], dt_s), errors[k][static_cast<std::size_t>(axis)]);
      accel.add(accel_row(perfect[k], axis, dt_s), errors[k][static_cast<std::size_t>(axis + 3)]);
    }
    const AxisRow of_gyro = gyro.solved(gyro_prior(axis)), of_accel = accel.solved(accel_prior(axis));
    terms.gyro.row(axis) = of_gyro.segment<3>(1);
    terms.g_sensitivity.row(axis) = of_gyro.segment<3>(4);
    terms.accel.row(axis) = of_accel.segment<3>(1);
    terms.accel_square[axis] = of_accel[4];
    terms.gyro_explained[axis] = gyro.explained(of_gyro);
    terms.accel_explained[axis] = accel.explained(of_accel);
  }
  return terms;
}

RecordedErrors::Increments motion_errors(const MotionTerms& terms, const RecordedErrors::Increments& perfect,
                                         double dt_s) {
  const Vector3 dv = velocity_of(perfect);
  const Vector3 theta = terms.gyro * rotation_of(perfect) + terms.g_sensitivity * dv;
  const Vector3 v = terms.accel * dv + terms.accel_square.cwiseProduct(dv.cwiseAbs2()) / dt_s;
  return {theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z()};
}

}  // namespace inslab::graft
