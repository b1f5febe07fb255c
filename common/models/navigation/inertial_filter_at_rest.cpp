#include <algorithm>
#include <cmath>

#include "inslab/models/navigation/inertial_filter.hpp"
#include "inslab/models/navigation/zero_velocity_update.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/symmetric.hpp"

/// What the filter makes of a time that feels like rest.
namespace inslab::navigation {

namespace {

/// Chi-square with 3 degrees of freedom that one honest zero velocity in a thousand is beyond.
constexpr double kRestLimit = 16.27;
/// How long a gain of velocity is summed up: 30 s of 0.005 m/s^2, which no second shows, are 0.15 m/s.
constexpr double kLongestGain_s = 30.0;
/// A rest that was contradicted is believed in again when so much time has nothing against it.
constexpr double kDoubt_s = 30.0;
/// Windows of rest, one after the other, that may wait for the next one.
constexpr double kMostHeld = 5.0;
/// How well gravity is known: 50 mGal, or a deflection of the vertical of 10 seconds of arc.
constexpr double kGravitySigma_m_per_s2 = 5e-4;
/// The mean of a receiver's velocities reaches back about so far: 5 a second of 0.05 m/s show 0.03 m/s.
constexpr double kMemory_s = 10.0;

}  // namespace

/// That what the forces of a time add to the velocity is 0: without R.
Measurement InertialFilter::gain_of_velocity(const Vector3& gain_n, double span_s) const {
  Measurement gain;
  gain.innovation = gain_n;
  gain.by(StateBlock::Attitude, span_s * nav::skew(-gravity_.g_n(strapdown_.position())));
  gain.by(StateBlock::AccelBias, -span_s * nav::matrix_from_quaternion(strapdown_.q_nb()));
  gain.by(StateBlock::Gravity, span_s * Matrix3::Identity());
  return gain;
}

/// Whether the forces of a time change the velocity by more than their errors can.
bool InertialFilter::gains_velocity(const Vector3& gain_n, double span_s) const {
  const double least = zero_velocity_.sigma_m_per_s * zero_velocity_.sigma_m_per_s;
  Measurement gain = gain_of_velocity(gain_n, span_s);
  gain.R = Vector3::Constant(least + span_s * noise_.accel_density.maxCoeff());
  return squared_normalised(gain) > kRestLimit;
}

/// The first second of a pull-away may gain less than sigma_m_per_s allows, and yet more than the IMU's own noise and
/// biases can make: then the next windows show which of the two it is. A sway never does, and must not keep zero
/// velocities away for good.
bool InertialFilter::waits_for_the_next_window() {
  const double n = rest_.window_intervals;
  // What shakes the vehicle shows in the spread of its intervals, and is white for all that a window tells.
  const Vector3 shaken = rest_.window_squares_n - rest_.window_gain_n.cwiseAbs2() / n;
  rest_.held_gain_n += rest_.window_gain_n;
  rest_.held_variance_n += shaken.cwiseMax(rest_.window_s * noise_.accel_density.maxCoeff());
  rest_.held_s += rest_.window_s;
  rest_.held_windows += 1.0;
  const Matrix3 C_nb = nav::matrix_from_quaternion(strapdown_.q_nb());
  const Vector3 f_b = -C_nb.transpose() * gravity_.g_n(strapdown_.position());
  Measurement gain = gain_of_velocity(rest_.held_gain_n, rest_.held_s);
  gain.by(StateBlock::AccelScale, -rest_.held_s * C_nb * f_b.asDiagonal());
  const double constant =
      kGravitySigma_m_per_s2 * kGravitySigma_m_per_s2 + noise_.unknown_bias + noise_.unknown_scale * f_b.squaredNorm();
  gain.R = rest_.held_variance_n + Vector3::Constant(rest_.held_s * rest_.held_s * constant);
  if (rest_.held_windows <= kMostHeld && squared_normalised(gain) > kRestLimit) return true;
  rest_.held_gain_n.setZero();
  rest_.held_variance_n.setZero();
  rest_.held_s = rest_.held_windows = 0.0;
  return false;
}

/// What a receiver says of the IMU's velocity and of its displacement, whatever the filter believes: zero velocities
/// that were taken make it sure of itself, and their errors are all alike.
void InertialFilter::hear_at_rest(const Measurement& m) {
  if (m.says == Measurement::Says::Position) {
    const Vector3 variance = m.R;
    const nav::Geodetic place = nav::displaced(strapdown_.position(), -m.innovation);
    if (!rest_.first_place) {
      rest_.first_place = place;
      rest_.first_variance = variance;
    }
    const Vector3 way_n = nav::ned_from(*rest_.first_place, place);
    rest_.displacement = way_n.cwiseAbs2().cwiseQuotient(variance + rest_.first_variance).sum();
  } else if (m.says == Measurement::Says::Velocity) {
    const Vector3 information = m.R.cwiseInverse();
    rest_.information += information;
    rest_.weighted_v_n += information.cwiseProduct(strapdown_.v_n() - m.innovation);
  }
}

/// A gentle pull-away feels like rest: what the filter knows of its velocity, what the forces do to it and what the
/// receiver says must all agree with it.
bool InertialFilter::is_contradicted() const {
  const double variance = zero_velocity_.sigma_m_per_s * zero_velocity_.sigma_m_per_s;
  const Matrix3 S = covariance_.matrix().block<3, 3>(kVelocity, kVelocity) + variance * Matrix3::Identity();
  if (nav::squared_normalised(S, strapdown_.v_n()) > std::min(innovation_test_.limit, kRestLimit)) return true;
  if (gains_velocity(rest_.window_gain_n, rest_.window_s) || gains_velocity(rest_.gain_n, rest_.span_s)) return true;
  if (rest_.displacement > innovation_test_.limit) return true;
  // (sum v/s^2)^2 / (sum 1/s^2) is the mean's square over its variance.
  return rest_.information.minCoeff() > 0.0 &&
         rest_.weighted_v_n.cwiseAbs2().cwiseQuotient(rest_.information).sum() > kRestLimit;
}

/// What was taken for rest was none: what the forces added meanwhile was taken away, from the velocity and from its
/// way.
void InertialFilter::doubt_rest() {
  if (rest_.updates > 0.0) {
    const Vector3 way_n = 0.5 * rest_.span_s * rest_.gain_n;
    covariance_.add(kVelocity, rest_.gain_n * rest_.gain_n.transpose());
    covariance_.add(kPosition, way_n * way_n.transpose());
  }
  rest_ = Rest{};
  rest_.doubted_s = kDoubt_s;
}

void InertialFilter::rest() {
  if (strapdown_.v_n().norm() > zero_velocity_.speed_m_per_s) {
    rest_ = Rest{};
    return;
  }
  settle();
  rest_.gain_n += rest_.window_gain_n;
  rest_.span_s += rest_.window_s;
  const double kept = std::exp(-rest_.window_s / kMemory_s);
  rest_.information *= kept;
  rest_.weighted_v_n *= kept;
  if (is_contradicted()) {
    doubt_rest();
    return;
  }
  rest_.doubted_s -= rest_.window_s;
  if (rest_.span_s >= kLongestGain_s) {
    rest_.gain_n.setZero();
    rest_.span_s = 0.0;
  }
  if (rest_.doubted_s > 0.0 || waits_for_the_next_window()) return;
  rest_.updates = std::min(zero_velocity_.windows_alike, rest_.updates + 1.0);
  const double variance = zero_velocity_.sigma_m_per_s * zero_velocity_.sigma_m_per_s;
  StateVector x = StateVector::Zero(layout_.size());
  take(ZeroVelocityUpdate::of(strapdown_.v_n(), rest_.updates * variance), x);
  correct(x);
}

}  // namespace inslab::navigation
