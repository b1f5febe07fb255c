#include "inslab/nav/strapdown.hpp"

#include <cmath>
#include <stdexcept>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::nav {

namespace {

/// Takes n coordinates to e coordinates: thesis (2-42).
Quaternion q_en_at(const Geodetic& position) {
  const double half = -0.25 * units::kPi - 0.5 * position.latitude_rad;
  const double c = std::cos(half), s = std::sin(half);
  const double c_lon = std::cos(0.5 * position.longitude_rad), s_lon = std::sin(0.5 * position.longitude_rad);
  return Quaternion(c * c_lon, -s * s_lon, s * c_lon, c * s_lon);
}

Geodetic position_of(const Quaternion& q_en, double height_m) {
  return {2.0 * std::atan2(std::hypot(q_en.x(), q_en.y()), std::hypot(q_en.w(), q_en.z())) - 0.5 * units::kPi,
          wrapped_to_pi(2.0 * std::atan2(q_en.z(), q_en.w())), height_m};
}

/// Sine and cosine of the latitude are entries of C_en; `q_en` need not have norm 1.
struct Latitude {
  explicit Latitude(const Quaternion& q_en)
      : sine((q_en.x() * q_en.x() + q_en.y() * q_en.y() - q_en.w() * q_en.w() - q_en.z() * q_en.z()) /
             q_en.squaredNorm()),
        cosine(2.0 * (q_en.x() * q_en.z() - q_en.w() * q_en.y()) / q_en.squaredNorm()) {}
  double sine;
  double cosine;
};

struct EarthRates {
  Vector3 omega_ie_n;
  Vector3 omega_en_n;
};

/// Thesis (2-25)..(2-28), rad/s.
EarthRates earth_rates(double sin_latitude, double cos_latitude, double height_m, const Vector3& v_n) {
  using namespace wgs84;
  const double inverse_w2 = 1.0 / (1.0 - e2 * sin_latitude * sin_latitude);
  const double N = a_m * std::sqrt(inverse_w2);
  const double M = N * (1.0 - e2) * inverse_w2;
  const double east = v_n.y() / (N + height_m);
  return {{omega_e_rad_per_s * cos_latitude, 0.0, -omega_e_rad_per_s * sin_latitude},
          {east, -v_n.x() / (M + height_m), -east * sin_latitude / cos_latitude}};
}

Vector3 earth_turn_e(double dt_s) { return {0.0, 0.0, wgs84::omega_e_rad_per_s * dt_s}; }

void require_interval(double dt_s) {
  if (!(dt_s > 0.0) || !std::isfinite(dt_s)) throw std::invalid_argument("an IMU interval must be longer than 0 s");
}

const Geodetic& checked(const Geodetic& position) {
  check_domain(position);
  return position;
}

}  // namespace

Strapdown::Strapdown(const NavState& start, const Gravity& gravity, const Options& options,
                     const std::optional<ImuIncrements>& before)
    : gravity_(gravity),
      options_(options),
      q_en_(q_en_at(checked(start.position))),
      height_m_(start.position.height_m),
      v_n_(start.v_n),
      q_nb_(canonical(start.q_nb)) {
  if (!before) return;
  require_interval(before->dt_s);
  before_ = *before;
  dv_n_before_ = matrix_from_quaternion(q_nb_.value()) * before->dv_b + gravity_.g_n(start.position) * before->dt_s;
}

double Strapdown::two_sample_factor(double dt_s) const {
  return before_.dt_s > 0.0 ? dt_s * dt_s / (6.0 * before_.dt_s * (before_.dt_s + dt_s)) : 0.0;
}

/// Thesis (2-30), (2-34)..(2-41); zeta_(k-1/2) with the half that the text after (2-38) lost.
Strapdown::Extrapolated Strapdown::extrapolate(double dt_s) const {
  const Quaternion q_en = q_en_.value();
  const Latitude now(q_en);
  const EarthRates rates_now = earth_rates(now.sine, now.cosine, height_m_.value(), v_n_);
  const Vector3 half_way_n = 0.5 * dt_s * (rates_now.omega_ie_n + rates_now.omega_en_n);
  const Quaternion q_en_middle =
      quaternion_from_rotation_vector(earth_turn_e(-0.5 * dt_s)) * q_en * quaternion_from_rotation_vector(half_way_n);
  const Latitude middle(q_en_middle);
  const double height_m = height_m_.value() - 0.5 * dt_s * v_n_.z();
  const Vector3 v_n = before_.dt_s > 0.0 ? Vector3(v_n_ + 0.5 * dt_s / before_.dt_s * dv_n_before_) : v_n_;

  const EarthRates rates = earth_rates(middle.sine, middle.cosine, height_m, v_n);
  const Vector3 coriolis_n = (2.0 * rates.omega_ie_n + rates.omega_en_n).cross(v_n);
  const Vector3 g_n = gravity_.g_n(middle.sine, height_m, [&] { return position_of(q_en_middle, height_m); });
  return {middle.sine, middle.cosine, 0.5 * dt_s * (rates.omega_ie_n + rates.omega_en_n), dt_s * (g_n - coriolis_n)};
}

/// Thesis (2-43)..(2-47) with the middle's velocity interpolated, then (2-55), (2-56).
Strapdown::Moved Strapdown::move(const Extrapolated& middle, const Vector3& v_n, double dt_s) const {
  const Vector3 v_middle_n = 0.5 * (v_n_ + v_n);
  const double height_m = height_m_.value() - 0.5 * dt_s * v_middle_n.z();
  const EarthRates rates = earth_rates(middle.sin_latitude, middle.cos_latitude, height_m, v_middle_n);
  Moved moved{q_en_, height_m_, Vector3::Zero()};
  moved.height_m.add(-dt_s * v_middle_n.z());
  moved.q_en.turn_source(dt_s * (rates.omega_ie_n + rates.omega_en_n));
  moved.q_en.turn_target(earth_turn_e(-dt_s));

  // Half the rotation from one unit quaternion to another is their sum, normalised.
  const Quaternion start = q_en_.value(), end = moved.q_en.value();
  const Latitude half_way(Quaternion(start.coeffs() + end.coeffs()));
  const EarthRates rates_half_way = earth_rates(half_way.sine, half_way.cosine, height_m, v_middle_n);
  moved.zeta_n = dt_s * (rates_half_way.omega_ie_n + rates_half_way.omega_en_n);
  return moved;
}

void Strapdown::advance(const ImuIncrements& imu) {
  require_interval(imu.dt_s);
  const Vector3& dtheta = imu.dtheta_b;
  const Vector3& dv = imu.dv_b;
  const double factor = two_sample_factor(imu.dt_s);

  // (2-32), (2-33), (2-29)
  const Vector3 rotation = dtheta.cross(dv);
  Vector3 dv_b_start = dv + 0.5 * rotation + factor * (before_.dtheta_b.cross(dv) + before_.dv_b.cross(dtheta));
  if (options_.full_rotation_term) dv_b_start += dtheta.cross(rotation) / 6.0;
  const Extrapolated middle = extrapolate(imu.dt_s);
  const Vector3 dv_n_start = matrix_from_quaternion(q_nb_.value()) * dv_b_start;
  const Vector3 dv_n = dv_n_start - middle.half_zeta_n.cross(dv_n_start) + middle.dv_gcor_n;
  const Moved moved = move(middle, v_n_ + dv_n, imu.dt_s);

  // (2-48)..(2-54), (2-57)
  q_nb_.turn_source(dtheta + factor * before_.dtheta_b.cross(dtheta));
  q_nb_.turn_target(-moved.zeta_n);
  q_en_ = moved.q_en;
  height_m_ = moved.height_m;
  v_n_ += dv_n;
  dv_n_before_ = dv_n;
  before_ = imu;
}

void Strapdown::hold_vertical(double height_m, double v_d_m_per_s) {
  height_m_ = CompensatedSum(height_m);
  dv_n_before_.z() += v_d_m_per_s - v_n_.z();
  v_n_.z() = v_d_m_per_s;
}

ImuIncrements Strapdown::increments_to(const Vector3& v_n, const Quaternion& q_nb, double dt_s) const {
  require_interval(dt_s);
  const double factor = two_sample_factor(dt_s);
  const Extrapolated middle = extrapolate(dt_s);
  const Moved moved = move(middle, v_n, dt_s);
  const Quaternion q_nb_start = q_nb_.value();

  // Phi = dtheta + factor dtheta_before x dtheta is linear in dtheta.
  const Vector3 Phi =
      rotation_vector_from_quaternion(q_nb_start.conjugate() * quaternion_from_rotation_vector(moved.zeta_n) * q_nb);
  const Matrix3 coning = Matrix3::Identity() + factor * skew(before_.dtheta_b);
  const Vector3 dtheta = coning.inverse() * Phi;

  const Matrix3 turn = Matrix3::Identity() - skew(middle.half_zeta_n);
  const Vector3 dv_b_start =
      matrix_from_quaternion(q_nb_start).transpose() * (turn.inverse() * (v_n - v_n_ - middle.dv_gcor_n));
  const Matrix3 rotation = skew(dtheta);
  Matrix3 sculling = coning + 0.5 * rotation;
  if (options_.full_rotation_term) sculling += rotation * rotation / 6.0;
  const Vector3 dv = sculling.inverse() * (dv_b_start - factor * before_.dv_b.cross(dtheta));
  return {dtheta, dv, dt_s};
}

NavState Strapdown::state() const { return {position(), v_n_, q_nb()}; }

Geodetic Strapdown::position() const { return position_of(q_en_.value(), height_m_.value()); }

Quaternion Strapdown::q_nb() const { return canonical(q_nb_.value()); }

}  // namespace inslab::nav
