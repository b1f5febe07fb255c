#include "inslab/models/navigation/initializer.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/nav/alignment.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::navigation {

namespace {

// More than this of heading a filter of small angles cannot begin with.
constexpr double kMostHeading_rad = 20.0 * units::kDeg;
constexpr double kBetweenTurns_s = 0.25;

/// At least these sigmas of three errors; what is added is for itself.
void raise_variances(StateMatrix& P, Eigen::Index first, const Vector3& least) {
  P.diagonal().segment<3>(first) = P.diagonal().segment<3>(first).cwiseMax(least.cwiseAbs2());
}

}  // namespace

Vector3 alignment_sigmas(const NavigationParameters& p, double span_s, double latitude_rad, double gravity_m_per_s2) {
  const double vrw = units::kMPerSPerSqrtH * p.accel.vrw_m_per_s_per_sqrt_h.maxCoeff();
  const double arw = units::kDegPerSqrtH * p.gyro.arw_deg_per_sqrt_h.maxCoeff();
  const double force_m_per_s2 = std::hypot(vrw / std::sqrt(span_s), units::kMGal * p.accel.bias_sigma_mgal.maxCoeff());
  const double rate_rad_per_s =
      std::hypot(arw / std::sqrt(span_s), units::kDegPerH * p.gyro.bias_sigma_deg_per_h.maxCoeff());
  const double tilt = force_m_per_s2 / gravity_m_per_s2;
  return {tilt, tilt, rate_rad_per_s / nav::omega_ie_n(latitude_rad).x()};
}

Initializer::Initializer(const NavigationParameters& parameters, const nav::Gravity& gravity)
    : parameters_(parameters), layout_(parameters.states), gravity_(gravity), motion_(parameters, gravity) {}

void Initializer::add(const GnssFix& fix) {
  fix_ = fix;
  motion_.add(fix);
  const double sigma_m_per_s = fix.velocity_sigma_ned_m_per_s.maxCoeff();
  if (parameters_.initial.attitude == InitialAttitude::Given || sigma_m_per_s <= 0.0) return;
  constexpr double kSurely = 5.0;  // standard deviations
  if (fix.v_n.norm() > parameters_.zero_velocity.speed_m_per_s + kSurely * sigma_m_per_s) {
    refuse("the receiver says that it moves; alignment needs rest");
  }
}

/// Begins the alignment anew.
void Initializer::refuse(const std::string& reason) {
  refusal_ = reason;
  span_s_ = count_ = 0.0;
  dtheta_sum_ = dv_sum_ = f_sum_ = f_squares_ = Vector3::Zero();
  turns_.clear();
}

/// How far the IMU turned from its mean rate, at most: what a sway, cut off anywhere, leaves in the mean.
double Initializer::sway_rad() const {
  if (turns_.size() < 3) return 0.0;
  double n = 0.0, t_sum = 0.0, t_squares = 0.0;
  Vector3 turn_sum = Vector3::Zero(), product = Vector3::Zero();
  for (const auto& [t_s, turn] : turns_) {
    n += 1.0;
    t_sum += t_s;
    t_squares += t_s * t_s;
    turn_sum += turn;
    product += t_s * turn;
  }
  const Vector3 rate = (product - t_sum / n * turn_sum) / (t_squares - t_sum * t_sum / n);
  const Vector3 mean = turn_sum / n;
  double sway = 0.0;
  for (const auto& [t_s, turn] : turns_) sway = std::max(sway, (turn - mean - rate * (t_s - t_sum / n)).norm());
  // The angle's own random walk leaves its line by about this.
  const double walk = units::kDegPerSqrtH * parameters_.gyro.arw_deg_per_sqrt_h.maxCoeff() * std::sqrt(span_s_);
  return sway > 2.0 * walk ? sway : 0.0;
}

/// Standard deviations of an attitude from the rest so far.
Vector3 Initializer::static_sigmas() const {
  const nav::Geodetic place = geodetic_of(*fix_);
  Vector3 sigmas = alignment_sigmas(parameters_, span_s_, place.latitude_rad, gravity_.g_n(place).norm());
  // The attitude at the end is not the mean one, which the force says.
  const double sway = sway_rad();
  sigmas.head<2>() = (sigmas.head<2>().array().square() + sway * sway).sqrt();
  sigmas.z() = std::hypot(sigmas.z(), 2.0 * sway / span_s_ / nav::omega_ie_n(place.latitude_rad).x());
  return sigmas;
}

std::optional<Matrix3> Initializer::attitude() {
  const InitialState& initial = parameters_.initial;
  const Vector3 rpy_rad = units::kDeg * initial.rpy_deg;
  if (initial.attitude == InitialAttitude::Given) return nav::matrix_from_rpy({rpy_rad.x(), rpy_rad.y(), rpy_rad.z()});
  if (span_s_ < initial.alignment_s) return std::nullopt;
  const nav::StaticMeans means{dv_sum_ / span_s_, dtheta_sum_ / span_s_,
                               (f_squares_ / count_ - (f_sum_ / count_).cwiseAbs2()).cwiseMax(0.0).cwiseSqrt()};
  const nav::Geodetic place = geodetic_of(*fix_);
  const double gravity_m_per_s2 = gravity_.g_n(place).norm();
  if (const double heading_rad = static_sigmas().z();
      initial.attitude == InitialAttitude::StaticAlignment && heading_rad > kMostHeading_rad) {
    std::ostringstream why;
    why.precision(3);
    why << initial.alignment_s << " s of rest leave heading unsure by " << heading_rad / units::kDeg
        << " deg: the gyros' errors " << (sway_rad() > 0.0 ? "and the vehicle's sway " : "")
        << "against the Earth's rate";
    refuse(why.str());
    return std::nullopt;
  }
  const auto found = initial.attitude == InitialAttitude::Levelled
                         ? nav::levelled(means, rpy_rad.z(), gravity_m_per_s2, {})
                         : nav::coarse_alignment(means, fix_->latitude_rad, gravity_m_per_s2, {});
  if (const auto* reason = std::get_if<std::string>(&found)) {
    refuse(*reason);
    return std::nullopt;
  }
  return std::get<Matrix3>(found);
}

/// An attitude from rest errs with the sensors: it levels the force and finds no rate about east, so
///
///   phi_N = -u_E / g,  phi_E = u_N / g,  phi_D = (omega_D phi_N - w_E) / omega_N,
///
/// u = C_nb (delta b_a + f delta s_a), w = C_nb (delta b_g + omega delta s_g). A turn of the vehicle shows them apart.
/// Its sigmas are at least what the alignment can be: parameters that promise more would have honest fixes refused. A
/// heading that was given is as sure as the parameters say.
void Initializer::doubt_attitude(const Matrix3& C_nb, StateMatrix& P) const {
  const InitialState& initial = parameters_.initial;
  if (initial.attitude == InitialAttitude::Given) return;
  const bool finds_heading = initial.attitude == InitialAttitude::StaticAlignment;
  const nav::Geodetic place = geodetic_of(*fix_);
  const Vector3 g_n = gravity_.g_n(place);
  const Vector3 omega_n = nav::omega_ie_n(place.latitude_rad);
  Matrix3 by_force = Matrix3::Zero(), by_rate = Matrix3::Zero();
  by_force(0, 1) = -1.0 / g_n.z();
  by_force(1, 0) = 1.0 / g_n.z();
  if (finds_heading) {
    by_force.row(2) = omega_n.z() / omega_n.x() * by_force.row(0);
    by_rate(2, 1) = -1.0 / omega_n.x();
  }
  const Vector3 f_b = -C_nb.transpose() * g_n, omega_b = C_nb.transpose() * omega_n;
  // Of each sensor error three columns, which stay 0 where it is left out.
  using SensorColumns = Eigen::Matrix<double, 3, 12>;
  SensorColumns J = SensorColumns::Zero(), cross = SensorColumns::Zero();
  const auto errs_by = [&](Eigen::Index column, StateBlock block, const Matrix3& by_error) {
    if (!layout_.has(block)) return;
    const Eigen::Index first = layout_.first(block);
    J.middleCols<3>(column) = by_error;
    cross.middleCols<3>(column) = by_error * P.diagonal().segment<3>(first).asDiagonal();  // each is still for itself
    P.block<3, 3>(kAttitude, first) = cross.middleCols<3>(column);
    P.block<3, 3>(first, kAttitude) = cross.middleCols<3>(column).transpose();
  };
  errs_by(0, StateBlock::GyroBias, by_rate * C_nb);
  errs_by(3, StateBlock::AccelBias, by_force * C_nb);
  errs_by(6, StateBlock::GyroScale, by_rate * C_nb * omega_b.asDiagonal());
  errs_by(9, StateBlock::AccelScale, by_force * C_nb * f_b.asDiagonal());
  Matrix3 known = cross.lazyProduct(J.transpose());
  if (layout_.has(StateBlock::Gravity)) {
    // The plumb line is what it levels by: gravity that is added counts against a force that is.
    const Eigen::Index first = layout_.first(StateBlock::Gravity);
    const Matrix3 by_gravity = -by_force;
    const Matrix3 with_gravity = by_gravity * P.diagonal().segment<3>(first).asDiagonal();
    P.block<3, 3>(kAttitude, first) = with_gravity;
    P.block<3, 3>(first, kAttitude) = with_gravity.transpose();
    known += with_gravity * by_gravity.transpose();
  }
  Vector3 least = static_sigmas();
  if (!finds_heading) least.z() = 0.0;
  const Vector3 variances = P.diagonal().segment<3>(kAttitude).cwiseMax(least.cwiseAbs2());
  P.block<3, 3>(kAttitude, kAttitude) = known;
  P.diagonal().segment<3>(kAttitude) = known.diagonal().cwiseMax(variances);
}

std::optional<Beginning> Initializer::add(const ImuSample& sample) {
  const double dt_s = time::to_seconds(sample.interval_ns);
  const Vector3 f_b = sample.dv_b / dt_s;
  if (count_ == 0.0) f_first_ = f_b;
  span_s_ += dt_s;
  count_ += 1.0;
  dtheta_sum_ += sample.dtheta_b;
  dv_sum_ += sample.dv_b;
  f_sum_ += f_b - f_first_;
  f_squares_ += (f_b - f_first_).cwiseAbs2();
  if (turns_.empty() || span_s_ - turns_.back().first >= kBetweenTurns_s) turns_.emplace_back(span_s_, dtheta_sum_);
  const bool by_motion = parameters_.initial.attitude == InitialAttitude::StaticAlignment;
  // What saturates is less than what acts; without the sample motion begins anew.
  if (by_motion && !sample.gyro_saturated && !sample.accel_saturated) motion_.add(sample);
  if (!fix_) return std::nullopt;
  if (const std::optional<Matrix3> C_nb = attitude()) return at_rest(sample, *C_nb);
  if (by_motion && motion_.result()) return in_motion(sample, *motion_.result());
  return std::nullopt;
}

Beginning Initializer::at_rest(const ImuSample& sample, const Matrix3& C_nb) const {
  Beginning beginning;
  beginning.time_ns = sample.header.sim_time_ns;
  beginning.covariance = initial_sigmas(parameters_).cwiseAbs2().asDiagonal();
  beginning.state.q_nb = nav::quaternion_from_matrix(C_nb);
  doubt_attitude(C_nb, beginning.covariance);
  const bool has_velocity = fix_->velocity_sigma_ned_m_per_s.minCoeff() > 0.0;
  if (has_velocity) beginning.state.v_n = fix_->v_n;
  const double age_s = time::to_seconds(beginning.time_ns - fix_->header.sim_time_ns);
  beginning.state.position =
      nav::displaced(geodetic_of(*fix_), age_s * beginning.state.v_n - C_nb * parameters_.lever_arm_b_m);
  raise_variances(beginning.covariance, kPosition, fix_->position_sigma_ned_m);
  raise_variances(beginning.covariance, kVelocity, fix_->velocity_sigma_ned_m_per_s);
  return beginning;
}

/// The fix is older than the sample: the vehicle went on at the mean of the fix's velocity and the one now.
Beginning Initializer::in_motion(const ImuSample& sample, const MotionAlignment::Result& result) const {
  Beginning beginning;
  beginning.time_ns = sample.header.sim_time_ns;
  beginning.state.q_nb = nav::quaternion_from_matrix(result.C_nb);
  beginning.state.v_n = result.v_n;
  beginning.errors[StateBlock::GyroBias] = result.gyro_bias;
  beginning.errors[StateBlock::AccelBias] = result.accel_bias;
  const double age_s = time::to_seconds(beginning.time_ns - fix_->header.sim_time_ns);
  const Vector3 way_n = age_s * 0.5 * (fix_->v_n + result.v_n);
  beginning.state.position = nav::displaced(geodetic_of(*fix_), way_n - result.C_nb * parameters_.lever_arm_b_m);
  const StateVector sigmas = initial_sigmas(parameters_);
  StateMatrix& P = beginning.covariance;
  P = sigmas.cwiseAbs2().asDiagonal();
  const std::array<StateBlock, 4> found{StateBlock::Velocity, StateBlock::Attitude, StateBlock::GyroBias,
                                        StateBlock::AccelBias};
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (std::size_t j = 0; j < found.size(); ++j) {
      if (!layout_.has(found[i]) || !layout_.has(found[j])) continue;
      P.block<3, 3>(layout_.first(found[i]), layout_.first(found[j])) =
          result.covariance.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j));
    }
  }
  raise_variances(P, kPosition, fix_->position_sigma_ned_m);
  raise_variances(P, kVelocity, sigmas.segment<3>(kVelocity));
  raise_variances(P, kAttitude, sigmas.segment<3>(kAttitude));
  return beginning;
}

}  // namespace inslab::navigation
