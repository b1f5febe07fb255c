#include "inslab/models/trajectory/smooth_vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::trajectory {

namespace {

constexpr time::Nanoseconds kLongestStep{5000000};
// What Gauss's rule leaves of a force that turns by x in a step is x^6/2016000 of it: at 0.05 rad 8e-15.
constexpr double kLongestTurn_rad = 0.05;

/// Nodes and weights of Gauss's rule on [0, 1], exact for polynomials of the fifth degree.
constexpr double kFirstNode = 0.11270166537925831;  // (1 - sqrt(3/5))/2
constexpr std::array<double, 3> kGaussNodes{kFirstNode, 0.5, 1.0 - kFirstNode};
constexpr std::array<double, 3> kWeights{5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};

}  // namespace

SmoothVehicle::SmoothVehicle(const SmoothMotion& motion, const nav::Gravity& gravity)
    : motion_(motion), gravity_(gravity) {
  begin_path_piece();
  begin_rotation_piece();
  meet_pieces();
}

void SmoothVehicle::advance(time::Nanoseconds end) {
  dtheta_v_.setZero();
  dv_v_.setZero();
  while (now_ < end) {
    step(std::min({end, piece_.end, rotation_end_, now_ + longest_step()}));
    const bool path_ended = now_ == piece_.end && path_index_ + 1 < motion_.path->pieces();
    const bool rotation_ended = now_ == rotation_end_ && rotation_index_ + 1 < motion_.attitude->pieces();
    if (path_ended) {
      ++path_index_;
      begin_path_piece();
    }
    if (rotation_ended) {
      ++rotation_index_;
      begin_rotation_piece();
    }
    if (path_ended || rotation_ended) meet_pieces();
  }
}

void SmoothVehicle::begin_path_piece() {
  piece_ = motion_.path->piece(path_index_);
  const nav::Geodetic& origin = piece_.curve.origin;
  C_ek_ = nav::C_en(origin.latitude_rad, origin.longitude_rad);
  omega_ie_k_ = nav::omega_ie_n(origin.latitude_rad);
}

void SmoothVehicle::begin_rotation_piece() {
  rotation_ = motion_.attitude->piece(rotation_index_);
  rotation_start_ = motion_.attitude->start(rotation_index_);
  rotation_end_ = motion_.attitude->end(rotation_index_);
}

/// What depends on both pieces, and the present seen from them.
void SmoothVehicle::meet_pieces() {
  C_vk_at_rotation_start_ = nav::matrix_from_quaternion(rotation_.q_start).transpose() * C_ek_;
  const double path_time_s = time::to_seconds(now_ - piece_.start);
  place(path_time_s, here_);
  const Forces now = forces(path_time_s, time::to_seconds(now_ - rotation_start_), here_.g_k);
  here_.omega_iv_v = now.omega_iv_v;
  here_.f_v = now.f_v;
}

time::Nanoseconds SmoothVehicle::longest_step() const {
  const double rate_rad_per_s = here_.omega_iv_v.norm();
  if (rate_rad_per_s * time::to_seconds(kLongestStep) <= kLongestTurn_rad) return kLongestStep;
  return std::max(time::Nanoseconds(1),
                  time::Nanoseconds(static_cast<std::int64_t>(1e9 * kLongestTurn_rad / rate_rad_per_s)));
}

void SmoothVehicle::step(time::Nanoseconds end) {
  if (end <= now_) throw std::out_of_range("the motion ends at " + std::to_string(time::to_seconds(now_)) + " s");
  const double dt_s = time::to_seconds(end - now_);
  const double path_s = time::to_seconds(now_ - piece_.start);
  const double rotation_s = time::to_seconds(now_ - rotation_start_);
  const double path_end_s = time::to_seconds(end - piece_.start);
  Instant there;
  place(path_end_s, there);
  // Gravity follows the place, which a step hardly changes: the parabola through three values of it is exact to
  // rounding.
  const Vector3 g_middle_k = g_k_between(here_, there, dt_s);
  Vector3 omega_mean = Vector3::Zero(), f_mean = Vector3::Zero();
  for (std::size_t i = 0; i < kGaussNodes.size(); ++i) {
    const double x = kGaussNodes[i];
    const Vector3 g_k =
        (1.0 - x) * (1.0 - 2.0 * x) * here_.g_k + 4.0 * x * (1.0 - x) * g_middle_k + x * (2.0 * x - 1.0) * there.g_k;
    const Forces at_node = forces(path_s + x * dt_s, rotation_s + x * dt_s, g_k);
    omega_mean += kWeights[i] * at_node.omega_iv_v;
    f_mean += kWeights[i] * at_node.f_v;
  }
  dtheta_v_ += dt_s * omega_mean;
  dv_v_ += dt_s * f_mean;
  const Forces at_end = forces(path_end_s, time::to_seconds(end - rotation_start_), there.g_k);
  there.omega_iv_v = at_end.omega_iv_v;
  there.f_v = at_end.f_v;
  here_ = there;
  now_ = end;
}

Heave::Instant SmoothVehicle::heave(double path_time_s) const {
  return motion_.heave.at(time::to_seconds(piece_.start) + path_time_s);
}

/// Everything of `instant` that depends on the path alone.
void SmoothVehicle::place(double path_time_s, Instant& instant) const {
  using namespace nav::wgs84;
  const nav::Geodetic& origin = piece_.curve.origin;
  const nav::Geodetic change = nav::geodetic_change(origin, piece_.curve.displacement_k(piece_.law.value(path_time_s)));
  instant.position = {origin.latitude_rad + change.latitude_rad,
                      nav::wrapped_to_pi(origin.longitude_rad + change.longitude_rad),
                      origin.height_m + change.height_m};
  const double latitude = instant.position.latitude_rad;
  const Matrix3 C_kn = C_kn_at(latitude, change.longitude_rad);
  instant.C_nk = C_kn.transpose();
  instant.v_n = instant.C_nk * piece_.velocity_k(path_time_s);
  if (!motion_.heave.is_none()) {
    const Heave::Instant up = heave(path_time_s);
    instant.v_n += heave_motion(path_instant(piece_, path_time_s, gravity_), up).v_n;
    instant.position.height_m += up.up_m;
  }
  const double s = std::sin(latitude), c = std::cos(latitude), height = instant.position.height_m;
  instant.position_rate = {instant.v_n.x() / (meridian_radius_from_sine_m(s) + height),
                           instant.v_n.y() / ((transverse_radius_from_sine_m(s) + height) * c), -instant.v_n.z()};
  instant.g_k = C_kn * gravity_.g_n(s, height, [&instant] { return instant.position; });
}

/// Takes NED coordinates at a latitude, and at a longitude counted from the origin's, to k.
Matrix3 SmoothVehicle::C_kn_at(double latitude_rad, double longitude_rad) const {
  return nav::C_en(piece_.curve.origin.latitude_rad, 0.0).transpose() * nav::C_en(latitude_rad, longitude_rad);
}

/// Gravity half-way: the place is that of the cubic through both ends' places and velocities.
Vector3 SmoothVehicle::g_k_between(const Instant& start, const Instant& end, double dt_s) const {
  const nav::Geodetic& origin = piece_.curve.origin;
  const Vector3 bulge = dt_s / 8.0 * (start.position_rate - end.position_rate);
  const double latitude = 0.5 * (start.position.latitude_rad + end.position.latitude_rad) + bulge.x();
  const double longitude = 0.5 * (nav::wrapped_to_pi(start.position.longitude_rad - origin.longitude_rad) +
                                  nav::wrapped_to_pi(end.position.longitude_rad - origin.longitude_rad)) +
                           bulge.y();
  const double height = 0.5 * (start.position.height_m + end.position.height_m) + bulge.z();
  return C_kn_at(latitude, longitude) * gravity_.g_n({latitude, origin.longitude_rad + longitude, height});
}

SmoothVehicle::Forces SmoothVehicle::forces(double path_time_s, double rotation_time_s, const Vector3& g_k) const {
  Vector3 v_k = piece_.velocity_k(path_time_s), a_k = piece_.acceleration_k(path_time_s);
  if (!motion_.heave.is_none()) {
    const PathInstant path = path_instant(piece_, path_time_s, gravity_);
    const HeaveMotion added = heave_motion(path, heave(path_time_s));
    const Matrix3 C_kn = C_ek_.transpose() * path.C_en;
    v_k += C_kn * added.v_n;
    a_k += C_kn * added.a_n;
  }
  const Vector3 f_k = a_k + 2.0 * omega_ie_k_.cross(v_k) - g_k;

  const Vector3 phi = rotation_.phi(rotation_time_s);
  const nav::RotationFactors factors(phi.squaredNorm());
  // From the axes at the rotation piece's start to v: the inverse of the rotation by phi.
  const auto into_v = [&](const Vector3& vector_k) -> Vector3 {
    const Vector3 before = C_vk_at_rotation_start_ * vector_k;
    const Vector3 turned = phi.cross(before);
    return before - factors.S * turned + factors.A * phi.cross(turned);
  };
  return {nav::rate_from_rotation_vector(factors, phi, rotation_.phi_rate(rotation_time_s)) + into_v(omega_ie_k_),
          into_v(f_k)};
}

Quaternion SmoothVehicle::q_nv() const {
  const Quaternion q_ev = rotation_.q_ab(time::to_seconds(now_ - rotation_start_));
  return nav::quaternion_from_matrix(here_.C_nk * C_ek_.transpose() * nav::matrix_from_quaternion(q_ev));
}

}  // namespace inslab::trajectory
