#include "inslab/models/navigation/motion_alignment.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/symmetric.hpp"

namespace inslab::navigation {

namespace {

// Nearer fixes share what is slow in a receiver's error, so they count as one.
constexpr double kBetweenMatches_s = 0.8;
constexpr double kMatchTolerance_s = 1e-6;
constexpr std::size_t kFewestMatches = 5;
// A change of velocity that tells heading: at least this, and this many of its standard deviations.
constexpr double kLeastChange_m_per_s = 1.0;
constexpr double kSurely = 10.0;
// What a filter of small angles can begin with.
constexpr double kMostHeadingSigma_rad = 5.0 * units::kDeg;
constexpr double kMostTilt_rad = 3.0 * units::kDeg;
// Mean square of the residuals over what they should be; beyond it something is not as modelled.
constexpr double kWorstFit = 4.0;
// So many turns are a spin, and worth a word.
constexpr double kTurnsToTell = 3.0;
// Sigmas that are 0 would make the normal equations singular.
constexpr double kLeastForceBias_m_per_s2 = 1e-6;
constexpr double kLeastRateBias_rad_per_s = 1e-9;
constexpr double kG_m_per_s2 = 9.80665;

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Matrix3x12 = Eigen::Matrix<double, 3, 12>;

}  // namespace

MotionAlignment::MotionAlignment(const NavigationParameters& parameters, const nav::Gravity& gravity)
    : parameters_(parameters), gravity_(gravity) {
  // The random walk of the angle turns gravity by arw t^(3/2)/sqrt(3) of velocity: so long until that is 1 m/s.
  const double arw = units::kDegPerSqrtH * parameters.gyro.arw_deg_per_sqrt_h.maxCoeff();
  longest_s_ = std::clamp(std::pow(std::sqrt(3.0) / (kG_m_per_s2 * std::max(arw, 1e-9)), 2.0 / 3.0), 10.0, 90.0);
}

void MotionAlignment::add(const GnssFix& fix) {
  if (!(fix.velocity_sigma_ned_m_per_s.minCoeff() > 0.0)) return;
  newest_fix_ = fix;
  waiting_.push_back(fix);
}

void MotionAlignment::begin(std::int64_t time_ns) {
  start_ns_ = time_ns;
  past_ = {Integrals{}};
  past_.back().time_ns = time_ns;
  matches_.clear();
  result_.reset();
}

void MotionAlignment::add(const ImuSample& sample) {
  if (!newest_fix_) return;
  const std::int64_t begin_ns = sample.header.sim_time_ns - sample.interval_ns;
  constexpr std::int64_t kRounding_ns = 1000;
  if (past_.empty() || std::abs(past_.back().time_ns - begin_ns) > kRounding_ns || elapsed_s(begin_ns) > longest_s_) {
    begin(begin_ns);
  }
  result_.reset();
  integrate(sample);
  take_waiting_fixes();
}

void MotionAlignment::integrate(const ImuSample& sample) {
  const double dt_s = time::to_seconds(sample.interval_ns);
  Integrals next = past_.back();
  next.time_ns = sample.header.sim_time_ns;
  next.omega_ib_b = sample.dtheta_b / dt_s;
  next.turned_rad += sample.dtheta_b.norm();
  const Matrix3 C_b0b = nav::matrix_from_quaternion(next.q_b0b);
  const Vector3 dv_b0 = C_b0b * (sample.dv_b + 0.5 * sample.dtheta_b.cross(sample.dv_b));
  next.alpha_b0 += dv_b0;
  next.by_gyro_bias += nav::skew(dv_b0) * (next.by_accel_bias + 0.5 * dt_s * C_b0b);
  next.by_accel_bias += dt_s * C_b0b;
  next.q_b0b = (next.q_b0b * nav::quaternion_from_rotation_vector(sample.dtheta_b)).normalized();

  const GnssFix& fix = *newest_fix_;
  const nav::Geodetic place = geodetic_of(fix);
  const Vector3 omega_ie_n = nav::omega_ie_n(place.latitude_rad);
  const Vector3 turn_n = dt_s * (omega_ie_n + nav::omega_en_n(place, fix.v_n));
  const Quaternion q_half = next.q_n0n * nav::quaternion_from_rotation_vector(0.5 * turn_n);
  next.fall_n0 += q_half * (dt_s * (gravity_.g_n(place) - omega_ie_n.cross(fix.v_n)));
  next.q_n0n = (next.q_n0n * nav::quaternion_from_rotation_vector(turn_n)).normalized();
  past_.push_back(next);
  const double kept_s = parameters_.max_latency_s + dt_s;
  while (past_.size() > 2 && time::to_seconds(next.time_ns - past_[1].time_ns) > kept_s) past_.pop_front();
}

/// Between the samples the integrals go on in proportion.
std::optional<MotionAlignment::Integrals> MotionAlignment::at(std::int64_t time_ns) const {
  const auto after = std::lower_bound(past_.begin(), past_.end(), time_ns,
                                      [](const Integrals& one, std::int64_t t) { return one.time_ns < t; });
  if (after == past_.end()) return std::nullopt;
  if (after->time_ns == time_ns) return *after;
  if (after == past_.begin()) return std::nullopt;
  const Integrals &a = *std::prev(after), &b = *after;
  const double x = time::to_seconds(time_ns - a.time_ns) / time::to_seconds(b.time_ns - a.time_ns);
  Integrals between = b;
  between.time_ns = time_ns;
  between.q_b0b = a.q_b0b.slerp(x, b.q_b0b);
  between.q_n0n = a.q_n0n.slerp(x, b.q_n0n);
  between.alpha_b0 = (1.0 - x) * a.alpha_b0 + x * b.alpha_b0;
  between.by_accel_bias = (1.0 - x) * a.by_accel_bias + x * b.by_accel_bias;
  between.by_gyro_bias = (1.0 - x) * a.by_gyro_bias + x * b.by_gyro_bias;
  between.fall_n0 = (1.0 - x) * a.fall_n0 + x * b.fall_n0;
  return between;
}

void MotionAlignment::take_waiting_fixes() {
  const double vrw = units::kMPerSPerSqrtH * parameters_.accel.vrw_m_per_s_per_sqrt_h.maxCoeff();
  const double arw = units::kDegPerSqrtH * parameters_.gyro.arw_deg_per_sqrt_h.maxCoeff();
  bool is_new = false;
  while (!waiting_.empty() && waiting_.front().header.sim_time_ns <= past_.back().time_ns) {
    const GnssFix fix = waiting_.front();
    waiting_.pop_front();
    const std::int64_t time_ns = fix.header.sim_time_ns;
    if (!matches_.empty() &&
        time::to_seconds(time_ns - matches_.back().at.time_ns) < kBetweenMatches_s - kMatchTolerance_s) {
      continue;
    }
    const std::optional<Integrals> then = at(time_ns);
    if (!then) continue;
    Match match;
    match.at = *then;
    match.v_n = fix.v_n;
    match.y_n0 = then->q_n0n * fix.v_n - then->fall_n0;
    match.a_b0 = then->alpha_b0 + then->q_b0b * then->omega_ib_b.cross(parameters_.lever_arm_b_m);
    const double t_s = elapsed_s(time_ns);
    const double walk = vrw * vrw * t_s + kG_m_per_s2 * kG_m_per_s2 * arw * arw * t_s * t_s * t_s / 3.0;
    match.variance = fix.velocity_sigma_ned_m_per_s.cwiseAbs2() + Vector3::Constant(walk);
    matches_.push_back(match);
    is_new = true;
  }
  if (is_new) solve();
}

double MotionAlignment::change_of_velocity_m_per_s() const {
  double change = 0.0;
  for (const Match& match : matches_) {
    change = std::max(change, (match.v_n - matches_.front().v_n).head<2>().norm());
  }
  return change;
}

/// Wahba's problem for the matches about their mean.
Matrix3 MotionAlignment::first_attitude() const {
  Vector3 y = Vector3::Zero(), a = Vector3::Zero();
  double sum = 0.0;
  for (const Match& match : matches_) {
    const double weight = 1.0 / match.variance.maxCoeff();
    y += weight * match.y_n0;
    a += weight * match.a_b0;
    sum += weight;
  }
  y /= sum;
  a /= sum;
  Matrix3 B = Matrix3::Zero();
  for (const Match& match : matches_) {
    B += (match.y_n0 - y) * (match.a_b0 - a).transpose() / match.variance.maxCoeff();
  }
  const Eigen::JacobiSVD<Matrix3> svd(B, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant();
  return svd.matrixU() * Vector3(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
}

void MotionAlignment::solve() {
  const double change_m_per_s = change_of_velocity_m_per_s();
  const double sigma_m_per_s = newest_fix_->velocity_sigma_ned_m_per_s.head<2>().maxCoeff();
  const double needed_m_per_s = std::max(kLeastChange_m_per_s, kSurely * sigma_m_per_s);
  std::ostringstream why;
  why.precision(3);
  if (matches_.size() < kFewestMatches || change_m_per_s < needed_m_per_s) {
    why << "in the last " << elapsed_s(past_.back().time_ns) << " s the receiver's velocity changed by "
        << change_m_per_s << " m/s, and heading by motion needs " << needed_m_per_s;
    why_not_ = why.str();
    return;
  }
  Matrix3 C = first_attitude();
  Vector3 v0 = matches_.front().y_n0 - C * matches_.front().a_b0, accel_bias = Vector3::Zero(),
          gyro_bias = Vector3::Zero();
  Vector3 accel_sigma =
      (units::kMGal * parameters_.accel.bias_sigma_mgal).cwiseMax(Vector3::Constant(kLeastForceBias_m_per_s2));
  if (parameters_.states.gravity_disturbance) {
    // Over so short a way it cannot be told from a bias.
    const double gravity_sigma = units::kMGal * parameters_.gravity_disturbance.sigma_ned_mgal.maxCoeff();
    accel_sigma = (accel_sigma.array().square() + gravity_sigma * gravity_sigma).sqrt();
  }
  const Vector3 gyro_sigma =
      (units::kDegPerH * parameters_.gyro.bias_sigma_deg_per_h).cwiseMax(Vector3::Constant(kLeastRateBias_rad_per_s));
  const auto jacobian = [&](const Vector3& a, const Integrals& then) {
    Matrix3x12 J;
    J << -nav::skew(C * a), Matrix3::Identity(), -C * then.by_accel_bias, C * then.by_gyro_bias;
    return J;
  };
  Matrix12 covariance = Matrix12::Zero();
  double squares = 0.0;
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    Matrix12 information = Matrix12::Zero();
    Vector12 right = Vector12::Zero();
    information.diagonal().segment<3>(6) = accel_sigma.cwiseAbs2().cwiseInverse();
    information.diagonal().segment<3>(9) = gyro_sigma.cwiseAbs2().cwiseInverse();
    right.segment<3>(6) = -accel_bias.cwiseQuotient(accel_sigma.cwiseAbs2());
    right.segment<3>(9) = -gyro_bias.cwiseQuotient(gyro_sigma.cwiseAbs2());
    squares = 0.0;
    for (const Match& match : matches_) {
      const Vector3 a = match.a_b0 - match.at.by_accel_bias * accel_bias + match.at.by_gyro_bias * gyro_bias;
      const Vector3 residual = match.y_n0 - v0 - C * a;
      const Matrix3x12 J = jacobian(a, match.at);
      const Eigen::Matrix<double, 12, 3> weighted = J.transpose() * match.variance.cwiseInverse().asDiagonal();
      information += weighted.lazyProduct(J);
      right += weighted * residual;
      squares += residual.cwiseAbs2().cwiseQuotient(match.variance).sum();
    }
    // The scales of the unknowns differ by many powers of ten.
    const Vector12 scale = information.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix12 scaled = scale.asDiagonal() * information * scale.asDiagonal();
    covariance = nav::inverse_of_symmetric(scaled).cwiseProduct(scale * scale.transpose());
    const Vector12 x = covariance * right;
    C = nav::matrix_from_quaternion(nav::quaternion_from_rotation_vector(x.head<3>())) * C;
    v0 += x.segment<3>(3);
    accel_bias += x.segment<3>(6);
    gyro_bias += x.segment<3>(9);
  }
  const double fit = squares / static_cast<double>(3 * matches_.size() - 6);
  covariance *= std::max(1.0, fit);

  const Integrals& now = past_.back();
  const Matrix3 C_n0n = nav::matrix_from_quaternion(now.q_n0n);
  const Vector3 alpha = now.alpha_b0 - now.by_accel_bias * accel_bias + now.by_gyro_bias * gyro_bias;
  const Matrix3 C_nn0 = C_n0n.transpose();
  Matrix3x12 attitude_now = Matrix3x12::Zero();
  attitude_now.leftCols<3>().setIdentity();
  attitude_now.rightCols<3>() = -C * now.by_accel_bias;
  const double arw = units::kDegPerSqrtH * parameters_.gyro.arw_deg_per_sqrt_h.maxCoeff();
  // A whole turn leaves no rotation and all of its scale factor's error.
  const double scale_rad = units::kPpm * parameters_.gyro.scale_factor_sigma_ppm.maxCoeff() * now.turned_rad;
  // The unknowns are the truth less the estimate: attitude's is phi, the others' have their signs turned.
  Matrix12 errors = Matrix12::Zero();
  errors.topRows<3>() = -C_nn0 * jacobian(alpha, now);
  errors.middleRows<3>(3) = C_nn0 * attitude_now;
  errors.block<3, 3>(6, 9) = errors.block<3, 3>(9, 6) = -Matrix3::Identity();
  Result result;
  result.C_nb =
      C_nn0 * C *
      nav::matrix_from_quaternion(nav::quaternion_from_rotation_vector(-now.by_accel_bias * gyro_bias) * now.q_b0b);
  result.v_n = C_nn0 * (v0 + C * alpha + now.fall_n0);
  result.gyro_bias = gyro_bias;
  result.accel_bias = accel_bias;
  result.covariance = nav::carried(errors, covariance);
  result.covariance.diagonal().segment<3>(3).array() += arw * arw * elapsed_s(now.time_ns) + scale_rad * scale_rad;
  const Vector3 sigma_rad = result.covariance.diagonal().segment<3>(3).cwiseSqrt();
  if (fit > kWorstFit) {
    why << "the receiver's velocities do not fit the IMU's forces: " << std::sqrt(fit) << " times their sigmas";
  } else if (!(sigma_rad.z() <= kMostHeadingSigma_rad && sigma_rad.head<2>().maxCoeff() <= kMostTilt_rad)) {
    why << "motion leaves heading unsure by " << sigma_rad.z() / units::kDeg << " deg and tilt by "
        << sigma_rad.head<2>().maxCoeff() / units::kDeg << " deg";
    if (now.turned_rad > kTurnsToTell * 2.0 * units::kPi) {
      why << ", of which the gyros' scale factors make " << scale_rad / units::kDeg << " deg in "
          << now.turned_rad / (2.0 * units::kPi) << " turns";
    }
  } else {
    result_ = result;
  }
  why_not_ = why.str();
}

}  // namespace inslab::navigation
