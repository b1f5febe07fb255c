#include "inslab/referee/predict/error_growth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/second_order_drift.hpp"
#include "inslab/models/imu/triad_parameters.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/error_model.hpp"

namespace inslab::predict {
namespace {

constexpr Eigen::Index kPosition = 0, kVelocity = 3, kAttitude = 6;
constexpr Eigen::Index kFix = 9;  ///< slow errors of a receiver's position, then of its velocity
constexpr Eigen::Index kGravity = 15, kGravityChange = 18;  ///< of 1, where gravity departs from its model at all
constexpr Eigen::Index kAfterGravity = 21;
constexpr Eigen::Index kDown = 2;

Vector3 squares(const Vector3& v) { return v.cwiseAbs2(); }
Vector3 root(const Vector3& variances) { return variances.cwiseMax(0.0).cwiseSqrt(); }

void gather(SensedMeans& sums, const Vector3& increment, double dt_s) {
  const Vector3 x = increment / dt_s;
  sums.x += increment;
  sums.abs += increment.cwiseAbs();
  sums.square += x.cwiseProduct(increment);
  sums.cube += x.cwiseAbs2().cwiseProduct(increment);
  sums.product += dt_s * imu::cross_products(x);
}

SensedMeans over(const SensedMeans& sums, double time_s) {
  return {sums.x / time_s, sums.abs / time_s, sums.square / time_s, sums.cube / time_s, sums.product / time_s};
}

bool is_walk(const SensorTerm& term) { return term.kind == TermKind::BiasRandomWalk; }

bool is_fixed_value(TermKind kind) {
  return kind != TermKind::BiasTurnOn && kind != TermKind::BiasGaussMarkov && kind != TermKind::BiasRandomWalk &&
         kind != TermKind::BiasFlicker && kind != TermKind::ScaleTurnOn && kind != TermKind::ScaleGaussMarkov &&
         kind != TermKind::CrossAxisGaussMarkov;
}

bool is_turn_on(TermKind kind) { return kind == TermKind::BiasTurnOn || kind == TermKind::ScaleTurnOn; }

/// T^2 (2 r - 3 + 4 exp(-r) - exp(-2 r)) with r = dt/T, as a series where its terms cancel.
double variance_of_integral(double dt_s, double correlation_time_s) {
  const double r = dt_s / correlation_time_s;
  if (r < 0.02) return dt_s * dt_s * r * (2.0 / 3.0 - r / 2.0 + 7.0 / 30.0 * r * r);
  return correlation_time_s * correlation_time_s * (2.0 * r - 3.0 + 4.0 * std::exp(-r) - std::exp(-2.0 * r));
}

/// A B of any sizes: each fixed one would have Eigen's whole product compiled anew.
Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& A, const Eigen::Ref<const Eigen::MatrixXd>& B) {
  return A * B;
}

}  // namespace

ErrorGrowth::ErrorGrowth(const ImuErrorProfile& profile, const PredictedError& start, const nav::Gravity& gravity,
                         Vertical vertical, double step_s, const std::optional<GravityErrors>& gravity_errors)
    : gravity_(gravity),
      vertical_(vertical),
      step_s_(step_s),
      time_s_(start.time_s),
      first_term_(gravity_errors ? kAfterGravity : kGravity) {
  if (!(step_s > 0.0)) throw std::invalid_argument("a step of the prediction must be longer than 0 s");
  fix_times_s_[0] = fix_times_s_[1] = Vector3::Constant(std::numeric_limits<double>::infinity());
  P_ = Eigen::MatrixXd::Zero(first_term_, first_term_);
  P_.diagonal().setOnes();
  P_.diagonal().head<9>() << squares(start.position_n_m), squares(start.velocity_n_m_per_s),
      squares(start.attitude_n_rad);
  if (gravity_errors) {
    along_way_ = gravity_errors->along_way;
    if (gravity_errors->starts_on_plumb_line) begin_on_plumb_line(units::kG);
  }
  swap(profile);
  if (vertical_ == Vertical::Held) hold_vertical();
}

/// Levelled by a force that a departure d of gravity turned: phi_E = d_N/g, phi_N = -d_E/g.
void ErrorGrowth::begin_on_plumb_line(double gravity_m_per_s2) {
  const Vector3 lean = along_way_->sigma_n / gravity_m_per_s2;
  const auto err = [&](Eigen::Index phi, Eigen::Index gravity, double by) {
    P_(phi, phi) += by * by;
    P_(phi, gravity) = P_(gravity, phi) = by;
  };
  err(kAttitude + 1, kGravity, lean.x());
  err(kAttitude, kGravity + 1, -lean.y());
}

void ErrorGrowth::set_density(const ImuErrorProfile& profile) {
  gyro_density_ = squares(imu::in_si(profile.gyro).random_walk);
  accel_density_ = squares(imu::in_si(profile.accel).random_walk);
}

/// A state that no other knows anything of.
void ErrorGrowth::renew(Eigen::Index state, double variance) {
  P_.row(state).setZero();
  P_.col(state).setZero();
  P_(state, state) = variance;
}

void ErrorGrowth::swap(const ImuErrorProfile& profile) {
  if (gathered_.time_s > 0.0) step();
  set_density(profile);
  const std::vector<SensorTerm> now = terms_of(profile);
  const Continuity continuity = profile.request.continuity;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    SensorTerm& term = terms_[i];
    const auto state = first_term_ + static_cast<Eigen::Index>(i);
    const auto same = std::find_if(now.begin(), now.end(), [&](const SensorTerm& other) { return other.is_of(term); });
    const double amplitude = same == now.end() ? 0.0 : same->amplitude;
    if (is_fixed_value(term.kind)) {
      if (amplitude != term.amplitude) renew(state, 1.0);
    } else if (is_walk(term)) {
      if (continuity != Continuity::Keep) renew(state, 0.0);
    } else if (continuity == Continuity::Redraw) {
      renew(state, 1.0);
    } else if (continuity == Continuity::Reset && !is_turn_on(term.kind)) {
      renew(state, 0.0);
    }
    term.amplitude = amplitude;
    if (same != now.end()) term.correlation_time_s = same->correlation_time_s;
  }
  for (const SensorTerm& term : now) {
    if (std::any_of(terms_.begin(), terms_.end(), [&](const SensorTerm& other) { return other.is_of(term); })) continue;
    const bool begins_at_zero =
        is_walk(term) || (continuity == Continuity::Reset && !is_fixed_value(term.kind) && !is_turn_on(term.kind));
    terms_.push_back(term);
    P_.conservativeResizeLike(Eigen::MatrixXd::Zero(P_.rows() + 1, P_.cols() + 1));
    P_(P_.rows() - 1, P_.cols() - 1) = begins_at_zero ? 0.0 : 1.0;
  }
}

bool ErrorGrowth::advance(const ImuTruth& truth, double warmer_k, double warming_k_per_s) {
  const double dt_s = time::to_seconds(truth.interval_ns);
  if (!(dt_s > 0.0)) return false;
  // In the middle of the interval: half a sample of turning is 0.3 % of a term at 15 deg/s and 50 Hz.
  const nav::Matrix3 C_nb =
      nav::matrix_from_quaternion(truth.q_nb) * (nav::Matrix3::Identity() - 0.5 * nav::skew(truth.dtheta_b));
  gathered_.time_s += dt_s;
  gathered_.warmer_k += warmer_k * dt_s;
  gathered_.warmed_k += warming_k_per_s * dt_s;
  gathered_.C_nb += C_nb * dt_s;
  gathered_.dv_n += C_nb * truth.dv_b;
  gather(gathered_.gyro, truth.dtheta_b + truth.gyro_error.vibration, dt_s);
  gather(gathered_.accel, truth.dv_b + truth.accel_error.vibration, dt_s);
  last_ = truth;
  // Half a sample of tolerance: sums of dt round.
  if (gathered_.time_s + 0.5 * dt_s < step_s_) return false;
  step();
  return true;
}

/// Exact for each state alone: a constant, a walk of unit density, a Gauss-Markov process of unit variance. The
/// integral of the state over the step counts, its part in the drive and how the two go together.
ErrorGrowth::Steps ErrorGrowth::steps_of(double dt_s) const {
  const Eigen::Index count = P_.rows() - kFix;
  Steps steps;
  steps.decay = Eigen::VectorXd::Ones(count);
  steps.integral = Eigen::VectorXd::Constant(count, dt_s);
  steps.drive = steps.drive_with_integral = steps.drive_of_integral = Eigen::VectorXd::Zero(count);
  const auto gauss_markov = [&](Eigen::Index i, double T_s) {
    if (!std::isfinite(T_s)) return;
    const double decayed = -std::expm1(-dt_s / T_s);
    steps.decay[i] = 1.0 - decayed;
    steps.integral[i] = T_s * decayed;
    steps.drive[i] = -std::expm1(-2.0 * dt_s / T_s);
    steps.drive_with_integral[i] = T_s * decayed * decayed;
    steps.drive_of_integral[i] = variance_of_integral(dt_s, T_s);
  };
  for (int i = 0; i < 6; ++i) gauss_markov(i, fix_times_s_[i / 3][i % 3]);
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const auto i = first_term_ - kFix + static_cast<Eigen::Index>(k);
    if (terms_[k].amplitude == 0.0) continue;  // the process rests
    if (is_walk(terms_[k])) {
      steps.drive[i] = dt_s;
      steps.drive_with_integral[i] = 0.5 * dt_s * dt_s;
      steps.drive_of_integral[i] = dt_s * dt_s * dt_s / 3.0;
    } else {
      gauss_markov(i, terms_[k].correlation_time_s);
    }
  }
  return steps;
}

/// What a state of 1 does to the nine, per second.
Eigen::MatrixXd ErrorGrowth::effects(const SensedMotion& motion, const nav::Matrix3& C_nb,
                                     const nav::WayStep& way) const {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(9, P_.rows() - kFix);
  if (along_way_) {
    // What gravity has beside its model the app has not.
    const nav::Matrix3 departs = -nav::Matrix3(along_way_->sigma_n.asDiagonal());
    G.block<3, 3>(kVelocity, kGravity - kFix) = departs;
    G.block<3, 3>(kVelocity, kGravityChange - kFix) = way.mean_by_change * departs;
  }
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const SensorTerm& term = terms_[k];
    const Vector3 error_n = C_nb * effect(term, motion);
    const auto column = first_term_ - kFix + static_cast<Eigen::Index>(k);
    if (term.triad == Triad::Gyro) {
      G.block<3, 1>(kAttitude, column) = -error_n;
    } else {
      G.block<3, 1>(kVelocity, column) = error_n;
    }
  }
  return G;
}

/// Phi and the sensors' effects to second order in the step, white noise by the trapezoid of both its ends.
void ErrorGrowth::step() {
  const double dt_s = gathered_.time_s;
  const nav::Matrix3 C_nb = gathered_.C_nb / dt_s;
  const SensedMotion motion{over(gathered_.gyro, dt_s), over(gathered_.accel, dt_s), gathered_.warmer_k / dt_s,
                            gathered_.warmed_k / dt_s};
  const nav::Matrix9 F = nav::error_dynamics(geodetic_of(last_), last_.v_n, gathered_.dv_n / dt_s, gravity_);
  const nav::Matrix9 to_middle = nav::Matrix9::Identity() + 0.5 * dt_s * F;
  const nav::Matrix9 Phi = nav::Matrix9::Identity() + dt_s * F.lazyProduct(to_middle);
  const nav::WayStep way = nav::way_step(along_way_ ? nav::share_of_correlation(*along_way_, last_.v_n, dt_s) : 0.0);
  const Eigen::MatrixXd B = product(to_middle, effects(motion, C_nb, way));
  const Steps steps = steps_of(dt_s);
  nav::Matrix9 Q = nav::Matrix9::Zero();
  Q.block<3, 3>(kAttitude, kAttitude) = dt_s * C_nb * gyro_density_.asDiagonal() * C_nb.transpose();
  Q.block<3, 3>(kVelocity, kVelocity) = dt_s * C_nb * accel_density_.asDiagonal() * C_nb.transpose();

  const Eigen::Index sensors = P_.rows() - kFix;
  P_.topLeftCorner<9, 9>() += 0.5 * Q;
  const Eigen::MatrixXd Phi_s = B * steps.integral.asDiagonal(), driven = B * steps.drive_of_integral.asDiagonal();
  const Eigen::MatrixXd half = product(Phi, P_.topRows(9)) + product(Phi_s, P_.bottomRows(sensors));
  const nav::Matrix9 nine = product(half.leftCols(9), Phi.transpose()) +
                            product(half.rightCols(sensors), Phi_s.transpose()) + product(driven, B.transpose()) +
                            0.5 * Q;
  P_.topLeftCorner<9, 9>() = 0.5 * (nine + nine.transpose());
  P_.topRightCorner(9, sensors) =
      half.rightCols(sensors) * steps.decay.asDiagonal() + B * steps.drive_with_integral.asDiagonal();
  P_.bottomLeftCorner(sensors, 9) = P_.topRightCorner(9, sensors).transpose();
  P_.bottomRightCorner(sensors, sensors).array() *= (steps.decay * steps.decay.transpose()).array();
  P_.bottomRightCorner(sensors, sensors).diagonal() += steps.drive;
  for (Eigen::Index axis = 0; along_way_ && axis < 3; ++axis) {
    nav::carry(way, 1.0, kGravity + axis, kGravityChange + axis, P_);
  }
  if (vertical_ == Vertical::Held) hold_vertical();
  time_s_ = time::to_seconds(last_.header.sim_time_ns);
  gathered_ = Gathered();
}

void ErrorGrowth::update(const Eigen::VectorXd& row, double variance) {
  const Eigen::VectorXd of_state = P_ * row;
  const double innovation = row.dot(of_state) + variance;
  if (innovation > 0.0) P_.noalias() -= (1.0 / innovation) * of_state * of_state.transpose();
}

void ErrorGrowth::measure(const SolutionErrors& fix, const Vector3& lever_arm_b_m) {
  if (gathered_.time_s > 0.0) step();
  const nav::Matrix3 C_nb = nav::matrix_from_quaternion(last_.q_nb);
  const double interval_s = time::to_seconds(last_.interval_ns);
  const Vector3 rate_b = interval_s > 0.0 ? Vector3(last_.dtheta_b / interval_s) : Vector3::Zero();
  const auto take = [&](Eigen::Index state, int slow, const Vector3& arm_n, const Vector3& white_sigma,
                        const Vector3& slow_sigma, const Vector3& slow_time_s) {
    const nav::Matrix3 by_attitude = nav::skew(arm_n);
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_slow = slow_sigma[axis] > 0.0;
      fix_times_s_[slow][axis] = is_slow ? slow_time_s[axis] : std::numeric_limits<double>::infinity();
      Eigen::VectorXd row = Eigen::VectorXd::Zero(P_.rows());
      row[state + axis] = 1.0;
      row.segment<3>(kAttitude) = by_attitude.row(axis);
      row[kFix + 3 * slow + axis] = slow_sigma[axis];
      if (state == kVelocity && !(white_sigma[axis] > 0.0) && !is_slow) continue;
      update(row, white_sigma[axis] * white_sigma[axis]);
    }
  };
  take(kPosition, 0, C_nb * lever_arm_b_m, fix.position_sigma_ned_m, fix.position_gm_sigma_ned_m,
       fix.position_gm_correlation_time_s);
  take(kVelocity, 1, C_nb * rate_b.cross(lever_arm_b_m), fix.velocity_sigma_ned_m_per_s,
       fix.velocity_gm_sigma_ned_m_per_s, fix.velocity_gm_correlation_time_s);
  if (vertical_ == Vertical::Held) hold_vertical();
}

void ErrorGrowth::hold_vertical() {
  for (const Eigen::Index state : {kPosition + kDown, kVelocity + kDown}) renew(state, 0.0);
}

PredictedError ErrorGrowth::current() const {
  const Eigen::VectorXd variances = P_.diagonal();
  return {time_s_, root(variances.segment<3>(kPosition)), root(variances.segment<3>(kVelocity)),
          root(variances.segment<3>(kAttitude))};
}

}  // namespace inslab::predict
