#include "inslab/models/navigation/inertial_filter.hpp"

#include <cmath>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/matching_gravity.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/error_model.hpp"
#include "inslab/nav/symmetric.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::navigation {

namespace {

/// 1/T, or 0 where T is 0 and the state a constant.
Vector3 decay_rates(const Vector3& correlation_times_s) {
  return (correlation_times_s.array() > 0.0).select(correlation_times_s.cwiseInverse(), 0.0);
}

/// The variance that a constant unknown rate or force adds to its integral from `from_s` to `to_s`.
double held_over_variance(double sigma, double dt_s, double to_s) {
  const double from_s = std::max(0.0, to_s - dt_s);
  return sigma * sigma * (to_s * to_s - from_s * from_s);
}

constexpr nav::Strapdown::Options kFullRotation{true};

}  // namespace

InertialFilter::Noise InertialFilter::noise_of(const NavigationParameters& p, const StateLayout& layout) {
  Noise noise;
  noise.gyro_density = (units::kDegPerSqrtH * p.gyro.arw_deg_per_sqrt_h).cwiseAbs2();
  noise.accel_density = (units::kMPerSPerSqrtH * p.accel.vrw_m_per_s_per_sqrt_h).cwiseAbs2();
  noise.sigma.resize(layout.chosen_size());
  noise.decay_rate.resize(layout.chosen_size());
  layout.for_each_chosen([&](StateBlock block) {
    const Process process = process_of(block, p);
    const Eigen::Index first = layout.first(block) - kNavStates, size = size_of(block);
    noise.sigma.segment(first, size) = process.sigma.head(size);
    noise.decay_rate.segment(first, size) = decay_rates(process.correlation_time_s).head(size);
  });
  const auto unknown = [&](StateBlock block) {
    return layout.has(block) ? 0.0 : process_of(block, p).sigma.cwiseAbs2().maxCoeff();
  };
  noise.unknown_bias = unknown(StateBlock::AccelBias);
  noise.unknown_scale = unknown(StateBlock::AccelScale);
  noise.gravity = along_way_of(p.gravity_disturbance);
  return noise;
}

InertialFilter::InertialFilter(const NavigationParameters& parameters, const nav::Gravity& gravity,
                               const nav::NavState& start, const Estimates& errors, const Covariance& covariance,
                               std::int64_t time_ns, const std::optional<nav::ImuIncrements>& before)
    : layout_(parameters.states),
      noise_(noise_of(parameters, layout_)),
      lever_arm_b_m_(parameters.lever_arm_b_m),
      innovation_test_(parameters.innovation_test),
      zero_velocity_(parameters.zero_velocity),
      coasting_(parameters.coasting),
      covariance_interval_s_(parameters.covariance_interval_s),
      gravity_(gravity),
      strapdown_(start, gravity, kFullRotation, before),
      covariance_(covariance),
      newest_(before.value_or(nav::ImuIncrements{})),
      time_ns_(time_ns),
      last_accepted_ns_(time_ns) {
  if (covariance.size() != layout_.size()) throw std::invalid_argument("the covariance is of another state");
  layout_.for_each_chosen([&](StateBlock block) { estimates_[block] = errors[block]; });
  if (parameters.odometer.number || parameters.other_odometer.number) recent_.emplace(time_ns);
}

nav::ImuIncrements InertialFilter::corrected(const nav::ImuIncrements& raw) const {
  const Estimates& e = estimates_;
  return {(raw.dtheta_b - raw.dt_s * e[StateBlock::GyroBias]).cwiseQuotient(Vector3::Ones() + e[StateBlock::GyroScale]),
          (raw.dv_b - raw.dt_s * e[StateBlock::AccelBias]).cwiseQuotient(Vector3::Ones() + e[StateBlock::AccelScale]),
          raw.dt_s};
}

void InertialFilter::advance(const ImuInterval& interval) {
  newest_ = corrected(interval.increments);
  const double dt_s = newest_.dt_s;
  const nav::Quaternion q_start = strapdown_.q_nb();
  const Vector3 v_n_start = strapdown_.v_n();
  const Vector3 v_b_start = recent_ ? Vector3(q_start.conjugate() * v_n_start) : Vector3(Vector3::Zero());
  if (sums_.dt_s == 0.0) sums_.v_n_start = v_n_start;
  strapdown_.advance(felt(newest_, q_start));
  if (interval.window_begins) {
    rest_.window_gain_n.setZero();
    rest_.window_squares_n.setZero();
    rest_.window_s = rest_.window_intervals = 0.0;
  }
  const Vector3 gain_n = strapdown_.v_n() - v_n_start;
  rest_.window_gain_n += gain_n;
  rest_.window_squares_n += gain_n.cwiseAbs2();
  rest_.window_intervals += 1.0;
  rest_.window_s += dt_s;
  if (interval.moves) rest_ = Rest{};

  // Half the turn between two unit quaternions of one sign is their sum, normalised.
  const nav::Quaternion q_end = strapdown_.q_nb();
  const double sign = q_start.dot(q_end) < 0.0 ? -1.0 : 1.0;
  const Matrix3 C_nb = nav::Quaternion(q_start.coeffs() + sign * q_end.coeffs()).normalized().toRotationMatrix();
  sums_.dt_s += dt_s;
  sums_.C_nb_dt += dt_s * C_nb;
  sums_.C_nb_dtheta += C_nb * newest_.dtheta_b.asDiagonal();
  sums_.C_nb_dv += C_nb * newest_.dv_b.asDiagonal();
  if (interval.rate_held_over_s > 0.0) {
    sums_.attitude_noise.diagonal().array() +=
        held_over_variance(units::kDegPerS * coasting_.rate_sigma_deg_per_s, dt_s, interval.rate_held_over_s);
  }
  if (interval.force_held_over_s > 0.0) {
    sums_.velocity_noise.diagonal().array() +=
        held_over_variance(coasting_.force_sigma_m_per_s2, dt_s, interval.force_held_over_s);
  }
  if (recent_) note_motion(v_b_start, interval.end_ns);
  time_ns_ = interval.end_ns;
  if (sums_.dt_s > covariance_interval_s_ - 0.5 * dt_s) settle();
  if (interval.at_rest) rest();
}

/// The mechanization knows gravity's model alone, so what is added to it comes in as a force.
nav::ImuIncrements InertialFilter::felt(const nav::ImuIncrements& increments, const nav::Quaternion& q_nb) const {
  if (!layout_.has(StateBlock::Gravity)) return increments;
  nav::ImuIncrements felt = increments;
  felt.dv_b += increments.dt_s * (q_nb.conjugate() * estimates_[StateBlock::Gravity]);
  return felt;
}

void InertialFilter::note_motion(const Vector3& v_b_begin, std::int64_t end_ns) {
  const nav::Quaternion q_bn = strapdown_.q_nb().conjugate();
  const Vector3 omega_ie_n = nav::omega_ie_n(strapdown_.position().latitude_rad);
  recent_->add(end_ns, v_b_begin, q_bn * strapdown_.v_n(), newest_.dtheta_b - newest_.dt_s * (q_bn * omega_ie_n));
}

/// Phi = I + A + A^2/2 with A the integral of F: docs/navigation.md says what that leaves out.
Transition InertialFilter::transition() const {
  const double dt_s = sums_.dt_s;
  const Vector3 v_n = 0.5 * (sums_.v_n_start + strapdown_.v_n());
  const Vector3 f_n = sums_.C_nb_dv.rowwise().sum() / dt_s;
  const Matrix9 A = dt_s * nav::error_dynamics(strapdown_.position(), v_n, f_n, gravity_);
  const Vector3 gyro_gain = (Vector3::Ones() + estimates_[StateBlock::GyroScale]).cwiseInverse();
  const Vector3 accel_gain = (Vector3::Ones() + estimates_[StateBlock::AccelScale]).cwiseInverse();
  NavByChosen B = NavByChosen::Zero(9, layout_.chosen_size());
  const auto block = [&](Eigen::Index row, StateBlock by) {
    return B.block<3, 3>(row, layout_.first(by) - kNavStates);
  };
  if (layout_.has(StateBlock::GyroBias))
    block(kAttitude, StateBlock::GyroBias) = sums_.C_nb_dt * gyro_gain.asDiagonal();
  if (layout_.has(StateBlock::GyroScale))
    block(kAttitude, StateBlock::GyroScale) = sums_.C_nb_dtheta * gyro_gain.asDiagonal();
  if (layout_.has(StateBlock::AccelBias))
    block(kVelocity, StateBlock::AccelBias) = -sums_.C_nb_dt * accel_gain.asDiagonal();
  if (layout_.has(StateBlock::AccelScale))
    block(kVelocity, StateBlock::AccelScale) = -sums_.C_nb_dv * accel_gain.asDiagonal();

  const bool has_gravity = layout_.has(StateBlock::Gravity);
  const nav::WayStep way = nav::way_step(has_gravity ? nav::share_of_correlation(noise_.gravity, v_n, dt_s) : 0.0);
  if (has_gravity) {
    block(kVelocity, StateBlock::Gravity) = dt_s * Matrix3::Identity();
    block(kVelocity, StateBlock::GravityChange) = dt_s * way.mean_by_change * Matrix3::Identity();
  }

  Transition t;
  t.nav_by_nav = Matrix9::Identity() + A + 0.5 * A.lazyProduct(A);
  t.nav_by_chosen = B + 0.5 * (A.lazyProduct(B) - B * (dt_s * noise_.decay_rate).asDiagonal());
  t.decay = (-dt_s * noise_.decay_rate).array().exp();
  const Matrix3 C_nb = sums_.C_nb_dt / dt_s;
  t.attitude_noise = C_nb * (dt_s * noise_.gyro_density).asDiagonal() * C_nb.transpose() + sums_.attitude_noise;
  t.velocity_noise = C_nb * (dt_s * noise_.accel_density).asDiagonal() * C_nb.transpose() + sums_.velocity_noise;
  // Half comes in before the decay and half after it; together they are sigma^2 (1 - decay^2).
  const auto decay_squared = t.decay.array().square();
  t.chosen_noise = 2.0 * noise_.sigma.cwiseAbs2().array() * (1.0 - decay_squared) / (1.0 + decay_squared);
  if (has_gravity) {
    t.gravity = Transition::Gravity{way, noise_.gravity.sigma_n.cwiseAbs2(), layout_.first(StateBlock::Gravity),
                                    layout_.first(StateBlock::GravityChange)};
  }
  return t;
}

void InertialFilter::settle() {
  if (sums_.dt_s <= 0.0) return;
  const Transition t = transition();
  covariance_.propagate(t);
  if (t.gravity) go_along(t.gravity->way);
  sums_ = Sums{};
}

/// The estimate goes on as what it estimates is expected to.
void InertialFilter::go_along(const nav::WayStep& way) {
  Vector3 &gravity = estimates_[StateBlock::Gravity], &change = estimates_[StateBlock::GravityChange];
  const Vector3 before = gravity;
  gravity = way.transition(0, 0) * before + way.transition(0, 1) * change;
  change = way.transition(1, 0) * before + way.transition(1, 1) * change;
}

Situation InertialFilter::situation() const {
  Situation at;
  at.position = strapdown_.position();
  at.v_n = strapdown_.v_n();
  at.C_nb = nav::matrix_from_quaternion(strapdown_.q_nb());
  if (newest_.dt_s > 0.0) {
    at.omega_ib_b = newest_.dtheta_b / newest_.dt_s;
    at.f_ib_b = newest_.dv_b / newest_.dt_s;
  }
  if (recent_) at.recent = &*recent_;
  at.estimates = estimates_;
  at.rate_by_measured = (Vector3::Ones() + estimates_[StateBlock::GyroScale]).cwiseInverse();
  return at;
}

double InertialFilter::squared_normalised(const Measurement& m) const {
  Eigen::MatrixXd S = nav::carried(m.H(layout_), covariance_.matrix());
  S.diagonal() += m.R;
  return nav::squared_normalised(S, m.innovation);
}

/// Row by row: the noise of each is its own.
void InertialFilter::take(const Measurement& m, StateVector& x) {
  for (Eigen::Index i = 0; i < m.rows(); ++i) covariance_.update(m.row(i, layout_), m.R[i], m.innovation[i], x);
}

UpdateResult InertialFilter::update(const std::vector<Measurement>& measurements) {
  settle();
  UpdateResult result;
  result.time_ns = time_ns_;
  const Measurement *position = nullptr, *velocity = nullptr;
  bool has_place = false;
  for (const Measurement& m : measurements) {
    if (zero_velocity_.use) hear_at_rest(m);
    const double nis = squared_normalised(m);
    result.measurements.push_back({m.name, m.rows(), nis, nis <= m.gate});
    if (m.says == Measurement::Says::Velocity) velocity = &m;
    if (m.says != Measurement::Says::Position) continue;
    position = &m;
    has_place = nis <= m.gate;
  }
  if (position != nullptr && !has_place && ++rejections_ > innovation_test_.rejections_before_recovery) {
    recover(*position, velocity);
    result.recovered = has_place = true;
    for (MeasurementResult& m : result.measurements) {
      m.accepted = m.name == position->name || (velocity != nullptr && m.name == velocity->name);
    }
  } else {
    StateVector x = StateVector::Zero(layout_.size());
    for (std::size_t i = 0; i < measurements.size(); ++i) {
      if (result.measurements[i].accepted) take(measurements[i], x);
    }
    correct(x);
  }
  if (has_place) {
    rejections_ = 0;
    last_accepted_ns_ = time_ns_;
  }
  return result;
}

/// The filter is lost: position and velocity become the receiver's, attitude is doubted by how far they were off.
void InertialFilter::recover(const Measurement& position, const Measurement* velocity) {
  StateVector x = StateVector::Zero(layout_.size());
  x.segment<3>(kPosition) = position.innovation;
  if (velocity != nullptr) x.segment<3>(kVelocity) = velocity->innovation;
  const double arm_m = lever_arm_b_m_.norm();
  const double unknown_speed = velocity != nullptr ? 0.0 : strapdown_.v_n().norm() + 1.0;
  const Vector3 velocity_variance = velocity != nullptr ? Vector3(velocity->R) : Vector3(Vector3::Zero());
  covariance_.forget(kPosition, (position.R.array() + arm_m * arm_m).matrix());
  covariance_.forget(kVelocity, (velocity_variance.array() + unknown_speed * unknown_speed + 0.01).matrix());
  covariance_.add(kAttitude, Matrix3::Identity() * (1e-2 * units::kDeg * units::kDeg));
  correct(x);
}

/// Takes the errors out of the estimates. The mechanization begins anew from there and keeps its two-sample terms.
void InertialFilter::correct(const StateVector& x) {
  nav::NavState state = strapdown_.state();
  const double s = std::sin(state.position.latitude_rad);
  const double m = nav::wgs84::meridian_radius_from_sine_m(s) + state.position.height_m;
  const double n = nav::wgs84::transverse_radius_from_sine_m(s) + state.position.height_m;
  const Vector3 r = x.segment<3>(kPosition);
  state.position.longitude_rad =
      nav::wrapped_to_pi(state.position.longitude_rad - r.y() / (n * std::cos(state.position.latitude_rad)));
  state.position.latitude_rad -= r.x() / m;
  state.position.height_m += r.z();
  state.v_n -= x.segment<3>(kVelocity);
  state.q_nb = nav::quaternion_from_rotation_vector(x.segment<3>(kAttitude)) * state.q_nb;
  layout_.for_each_chosen([&](StateBlock block) {
    estimates_[block].head(size_of(block)) -= x.segment(layout_.first(block), size_of(block));
  });
  strapdown_ =
      nav::Strapdown(state, gravity_, kFullRotation, newest_.dt_s > 0.0 ? std::optional(newest_) : std::nullopt);
}

}  // namespace inslab::navigation
