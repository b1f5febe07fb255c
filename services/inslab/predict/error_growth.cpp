#include "services/inslab/predict/error_growth.hpp"

#include <cmath>
#include <stdexcept>

#include "nav/attitude.hpp"
#include "nav/error_model.hpp"
#include "services/imu_error_injector/triad_parameters.hpp"

namespace inslab::predict {
namespace {

constexpr int kPosition = 0, kVelocity = 3, kAttitude = 6;
constexpr int kGyro = 9, kAccel = 21;
/// Within a triad.
constexpr int kBias = 0, kGaussMarkov = 3, kScale = 6, kScaleGaussMarkov = 9;
constexpr int kDown = 2;

/// Variances, decays and drives of the twelve states of a triad.
struct TriadStates {
  Eigen::Matrix<double, 12, 1> variance = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::Matrix<double, 12, 1> decay_per_s = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::Matrix<double, 12, 1> drive = Eigen::Matrix<double, 12, 1>::Zero();
};

Vector3 squares(const Vector3& v) { return v.cwiseAbs2(); }

/// A Gauss-Markov process in its steady state; its drive is 2 sigma^2 / T (lecture (57), (58)).
void set_gauss_markov(TriadStates& states, int at, const Vector3& sigma, const Vector3& correlation_time_s) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(sigma[axis] > 0.0)) continue;
    const double variance = sigma[axis] * sigma[axis];
    states.variance[at + axis] = variance;
    states.decay_per_s[at + axis] = 1.0 / correlation_time_s[axis];
    states.drive[at + axis] = 2.0 * variance / correlation_time_s[axis];
  }
}

TriadStates states_of(const imu::TriadParameters& triad) {
  TriadStates states;
  states.variance.segment<3>(kBias) =
      squares(triad.bias_constant) + squares(triad.bias_turn_on_sigma) + squares(triad.bias_instability);
  states.drive.segment<3>(kBias) = squares(triad.bias_random_walk);
  states.variance.segment<3>(kScale) = squares(triad.scale_factor) + squares(triad.scale_factor_turn_on_sigma);
  set_gauss_markov(states, kGaussMarkov, triad.bias_gm_sigma, triad.bias_gm_correlation_time_s);
  set_gauss_markov(states, kScaleGaussMarkov, triad.scale_factor_gm_sigma, triad.scale_factor_gm_correlation_time_s);
  return states;
}

Vector3 root(const Vector3& variances) { return variances.cwiseMax(0.0).cwiseSqrt(); }

}  // namespace

ErrorGrowth::ErrorGrowth(const ImuErrorProfile& profile, const PredictedError& start, const nav::Gravity& gravity,
                         Vertical vertical, double step_s)
    : gravity_(gravity), vertical_(vertical), step_s_(step_s), time_s_(start.time_s) {
  if (!(step_s > 0.0)) throw std::invalid_argument("a step of the prediction must be longer than 0 s");
  const imu::TriadParameters gyro = imu::in_si(profile.gyro), accel = imu::in_si(profile.accel);
  gyro_density_ = squares(gyro.random_walk);
  accel_density_ = squares(accel.random_walk);
  Vector variances;
  const TriadStates of_gyro = states_of(gyro), of_accel = states_of(accel);
  variances << squares(start.position_n_m), squares(start.velocity_n_m_per_s), squares(start.attitude_n_rad),
      of_gyro.variance, of_accel.variance;
  decay_per_s_.tail<24>() << of_gyro.decay_per_s, of_accel.decay_per_s;
  drive_.tail<24>() << of_gyro.drive, of_accel.drive;
  P_.diagonal() = variances;
  if (vertical_ == Vertical::Held) hold_vertical();
}

bool ErrorGrowth::advance(const TruthState& truth) {
  const double dt_s = static_cast<double>(truth.interval_ns) * 1e-9;
  if (!(dt_s > 0.0)) return false;
  gathered_s_ += dt_s;
  dtheta_b_ += truth.dtheta_v;
  dv_b_ += truth.dv_v;
  // Half a sample of tolerance: sums of dt round.
  if (gathered_s_ + 0.5 * dt_s < step_s_) return false;
  step(truth);
  return true;
}

/// Phi to second order in the step, and the noise of a step by the trapezoid of both its ends.
void ErrorGrowth::step(const TruthState& truth) {
  const double dt_s = gathered_s_;
  const nav::Matrix3 C_nb = nav::matrix_from_quaternion(truth.q_nv);
  const Vector3 rate_b = dtheta_b_ / dt_s, force_b = dv_b_ / dt_s;
  Matrix F = Matrix::Zero();
  F.topLeftCorner<9, 9>() = nav::error_dynamics({truth.latitude_rad, truth.longitude_rad, truth.height_m}, truth.v_n,
                                                C_nb * force_b, gravity_);
  for (const int bias : {kBias, kGaussMarkov}) {
    F.block<3, 3>(kAttitude, kGyro + bias) = -C_nb;
    F.block<3, 3>(kVelocity, kAccel + bias) = C_nb;
  }
  for (const int scale : {kScale, kScaleGaussMarkov}) {
    F.block<3, 3>(kAttitude, kGyro + scale) = -C_nb * rate_b.asDiagonal();
    F.block<3, 3>(kVelocity, kAccel + scale) = C_nb * force_b.asDiagonal();
  }
  F.diagonal() -= decay_per_s_;
  Matrix Q = drive_.asDiagonal();
  Q.block<3, 3>(kAttitude, kAttitude) = C_nb * gyro_density_.asDiagonal() * C_nb.transpose();
  Q.block<3, 3>(kVelocity, kVelocity) = C_nb * accel_density_.asDiagonal() * C_nb.transpose();

  const Matrix Phi = Matrix::Identity() + dt_s * F + 0.5 * dt_s * dt_s * F * F;
  P_ = (Phi * (P_ + 0.5 * dt_s * Q) * Phi.transpose() + 0.5 * dt_s * Q).eval();
  P_ = (0.5 * (P_ + P_.transpose())).eval();
  if (vertical_ == Vertical::Held) hold_vertical();
  time_s_ += dt_s;
  gathered_s_ = 0.0;
  dtheta_b_.setZero();
  dv_b_.setZero();
}

void ErrorGrowth::hold_vertical() {
  for (const int state : {kPosition + kDown, kVelocity + kDown}) {
    P_.row(state).setZero();
    P_.col(state).setZero();
  }
}

PredictedError ErrorGrowth::current() const {
  const Vector variances = P_.diagonal();
  return {time_s_, root(variances.segment<3>(kPosition)), root(variances.segment<3>(kVelocity)),
          root(variances.segment<3>(kAttitude))};
}

}  // namespace inslab::predict
