#include "inslab/models/trajectory/vehicle_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kLongestMotionStep_s = 5e-3;
// The middle of a step is placed with the radii of curvature of its start: over 2 m that errs by 1e-7 m in the place
// and 2e-14 m in the step.
constexpr double kLongestStep_m = 2.0;
constexpr double kRoundingOfPi = 1.2246467991473532e-16;  // pi - units::kPi
// Below this a difference of rates is rounding (a sine after whole periods), not a jump.
constexpr double kJump_rad_per_s = 1e-12;
// Gravity turns a vehicle of this speed by up to 10 rad/s; at rest the direction of its velocity means nothing.
constexpr double kSlowestFall_m_per_s = 1.0;
// A fourth-order step over which the attitude turns, or drag slows the vehicle, by this errs by 0.005^5/120 = 3e-14.
constexpr double kLargestChangePerFallStep = 0.005;

Vector3 simpson(const Vector3& start, const Vector3& middle, const Vector3& end, double dt_s) {
  return dt_s / 6.0 * (start + 4.0 * middle + end);
}

/// The integral over the first half of a step of the parabola through its start, middle and end.
Vector3 first_half(const Vector3& start, const Vector3& middle, const Vector3& end, double dt_s) {
  return dt_s / 24.0 * (5.0 * start + 8.0 * middle - end);
}

/// 1/2 integral of angle x omega over a step: by how much the rotation vector exceeds the integral of the rate, to
/// second order in the angle. Exact for rates that are polynomials of the fourth degree, the one through the step's
/// three rates and its halves' two integrals; 0 for a rate about one axis. Source: P. Savage, Strapdown
/// Analytics, 7.1.1.1, its coning integral evaluated for that polynomial.
Vector3 coning(const MotionInstant& start, const MotionInstant& middle, const MotionInstant& end, double dt_s) {
  const Vector3 first = middle.angle_nv_v - start.angle_nv_v;
  const Vector3 second = end.angle_nv_v - middle.angle_nv_v;
  const Vector3 w0 = dt_s * start.omega_nv_v, wm = dt_s * middle.omega_nv_v, w1 = dt_s * end.omega_nv_v;
  return 8.0 / 21.0 * first.cross(second) + w0.cross(23.0 / 630.0 * first + second / 90.0) +
         32.0 / 315.0 * wm.cross(second - first) - w1.cross(first / 90.0 + 23.0 / 630.0 * second) -
         2.0 / 315.0 * (w0 - w1).cross(wm) - w0.cross(w1) / 1260.0;
}

}  // namespace

VehicleMotion::VehicleMotion(const nav::Geodetic& position, const Vector3& v_v, const Quaternion& q_nv,
                             const nav::Gravity& gravity)
    : gravity_(gravity),
      segment_(MotionSegment::endless()),
      latitude_rad_(position.latitude_rad),
      longitude_rad_(nav::wrapped_to_pi(position.longitude_rad)),
      height_m_(position.height_m),
      q_nv_(nav::canonical(q_nv)),
      v_v_at_start_(v_v) {
  now_.C_nv = q_nv_.value().toRotationMatrix();
  now_.v_n = now_.C_nv * v_v;
  now_.nose_v = v_v;
  evaluate(now_, position);
}

bool VehicleMotion::begin(MotionSegment segment) {
  v_v_at_start_ = segment_.keeps_velocity_on_nose() ? now_.nose_v : v_v();
  if (!segment_.spin().is_none()) q_nv_ = nav::CompensatedQuaternion(q_nv());
  spun_ = Quaternion::Identity();
  segment_ = std::move(segment);
  if (!segment_.keeps_velocity_on_nose()) {
    std::transform(now_.v_n.data(), now_.v_n.data() + 3, v_n_, [](double c) { return nav::CompensatedSum(c); });
  }
  const Vector3 omega_before = now_.motion.omega_nv_v;
  if (segment_.is_ballistic()) {
    speed_m_per_s_ = nav::CompensatedSum(v_v_at_start_.norm());
    along_v_ = v_v_at_start_.normalized();
    now_ = falling(q_nv(), speed_m_per_s_.value(), position());
    spin_to(0.0);
  } else {
    now_.motion = segment_.at(0.0);
    now_.nose_v = segment_.keeps_velocity_on_nose() ? v_v_at_start_ : Vector3::Zero();
    evaluate(now_, position());
  }
  return (now_.motion.omega_nv_v - omega_before).cwiseAbs().maxCoeff() > kJump_rad_per_s;
}

double VehicleMotion::longest_step_s() const {
  const double speed = now_.v_n.norm();
  double step_s = std::min(kLongestMotionStep_s, segment_.longest_step_s());
  if (segment_.is_ballistic()) {
    const Vector3& omega_nv_v = now_.motion.omega_nv_v;
    const double turn =
        segment_.spin().is_none() ? omega_nv_v.norm() : (omega_nv_v - along_v_.dot(omega_nv_v) * along_v_).norm();
    const double rate = std::max(turn, *segment_.drag_per_m() * speed);
    step_s = std::min(step_s, kLargestChangePerFallStep / rate);
  }
  return speed * step_s > kLongestStep_m ? kLongestStep_m / speed : step_s;
}

void VehicleMotion::step(double t0_s, double t1_s, double dt_s) {
  if (segment_.is_ballistic()) {
    fall(t0_s, t1_s, dt_s);
    return;
  }
  Instant middle, end;
  middle.motion = segment_.at(t0_s + 0.5 * dt_s);
  end.motion = segment_.at(t1_s);
  find_velocities(middle, end, dt_s);

  // Metres moved become radians by the radii of curvature at the start, then at the middle. The longitude is only for
  // gravity that varies: metres do not matter there.
  const auto moved = [this, dt_s](const Vector3& way, double inverse_north_m, double east_rate, double share) {
    return nav::Geodetic{latitude_rad_.value() + way.x() * inverse_north_m,
                         longitude_rad_.value() + share * dt_s * east_rate, height_m_.value() - way.z()};
  };
  const Vector3 half_way = first_half(now_.v_n, middle.v_n, end.v_n, dt_s);
  evaluate(middle, moved(half_way, now_.inverse_north_m, now_.position_rate.y(), 0.5));
  const Vector3 way = simpson(now_.v_n, middle.v_n, end.v_n, dt_s);
  evaluate(end, moved(way, middle.inverse_north_m, middle.position_rate.y(), 1.0));

  add_to_position(simpson(now_.position_rate, middle.position_rate, end.position_rate, dt_s));
  increments_.dtheta_v += (end.motion.angle_nv_v - now_.motion.angle_nv_v) +
                          simpson(now_.omega_in_v, middle.omega_in_v, end.omega_in_v, dt_s);
  increments_.dv_v += (end.motion.speed_gained_v - now_.motion.speed_gained_v) + turning(middle, end, dt_s) +
                      simpson(now_.f_earth_v, middle.f_earth_v, end.f_earth_v, dt_s);
  now_ = end;
}

/// The integral of omega_nv_v x v_v over a step, by parts: exact while the speed is constant, however fast the turn.
Vector3 VehicleMotion::turning(const Instant& middle, const Instant& end, double dt_s) const {
  if (!segment_.turns() || !segment_.keeps_velocity_on_nose()) return Vector3::Zero();
  const Vector3 first = middle.motion.angle_nv_v - now_.motion.angle_nv_v;
  const Vector3 whole = end.motion.angle_nv_v - now_.motion.angle_nv_v;
  return whole.cross(end.nose_v) -
         simpson(Vector3::Zero(), first.cross(middle.motion.a_lin_v), whole.cross(end.motion.a_lin_v), dt_s);
}

/// Attitude and velocity at the middle and the end of a step; turns q_nv_ and, off the nose, adds to v_n_.
void VehicleMotion::find_velocities(Instant& middle, Instant& end, double dt_s) {
  middle.C_nv = end.C_nv = now_.C_nv;
  if (segment_.turns()) {
    const Vector3 first = middle.motion.angle_nv_v - now_.motion.angle_nv_v;
    const Vector3 second = end.motion.angle_nv_v - middle.motion.angle_nv_v;
    // Half-way the rate may be taken as linear: its error stays in this step's quadratures.
    const Vector3 half_way = first + first.cross(second) / 12.0;
    middle.C_nv = (q_nv() * nav::quaternion_from_rotation_vector(half_way)).toRotationMatrix();
    q_nv_.turn_source(first + second + coning(now_.motion, middle.motion, end.motion, dt_s));
    end.C_nv = q_nv().toRotationMatrix();
  }
  if (segment_.keeps_velocity_on_nose()) {
    middle.nose_v = v_v_at_start_ + middle.motion.speed_gained_v;
    end.nose_v = v_v_at_start_ + end.motion.speed_gained_v;
    middle.v_n = middle.C_nv * middle.nose_v;
    end.v_n = end.C_nv * end.nose_v;
    return;
  }
  middle.v_n = end.v_n = now_.v_n;
  if (!segment_.accelerates()) return;
  // The integral of C_nv a_lin by parts: exact while the attitude is constant, however fast the sway.
  const Vector3 gained_m = middle.motion.speed_gained_v - now_.motion.speed_gained_v;
  const Vector3 gained_1 = end.motion.speed_gained_v - now_.motion.speed_gained_v;
  const Vector3 rest_m = middle.C_nv * middle.motion.omega_nv_v.cross(gained_m);
  const Vector3 rest_1 = end.C_nv * end.motion.omega_nv_v.cross(gained_1);
  middle.v_n += middle.C_nv * gained_m - first_half(Vector3::Zero(), rest_m, rest_1, dt_s);
  const Vector3 change = end.C_nv * gained_1 - simpson(Vector3::Zero(), rest_m, rest_1, dt_s);
  for (int i = 0; i < 3; ++i) v_n_[i].add(change[i]);
  end.v_n = {v_n_[0].value(), v_n_[1].value(), v_n_[2].value()};
}

Vector3 VehicleMotion::drag_v(const Instant& instant) const {
  return -*segment_.drag_per_m() * instant.nose_v.norm() * instant.nose_v;
}

/// A ballistic vehicle at one time. Specific force is drag alone, which gives the acceleration; its part across the
/// velocity turns the vehicle.
VehicleMotion::Instant VehicleMotion::falling(const Quaternion& q_nv, double speed_m_per_s,
                                              const nav::Geodetic& position) const {
  if (!(speed_m_per_s >= kSlowestFall_m_per_s)) {
    throw std::domain_error("speed is " + std::to_string(speed_m_per_s) + " m/s; a ballistic vehicle needs at least " +
                            std::to_string(kSlowestFall_m_per_s) + " m/s for its attitude to follow the velocity");
  }
  Instant instant;
  instant.C_nv = q_nv.toRotationMatrix();
  instant.nose_v = speed_m_per_s * along_v_;
  instant.v_n = instant.C_nv * instant.nose_v;
  evaluate(instant, position);
  const Vector3 a_v = drag_v(instant) - instant.f_earth_v;
  instant.motion.omega_nv_v = along_v_.cross(a_v) / speed_m_per_s;
  instant.motion.a_lin_v = along_v_.dot(a_v) * along_v_;
  return instant;
}

/// The rotation vector's derivative is the Bortz equation to second order in the angle; the third vanishes.
VehicleMotion::FallChange VehicleMotion::fall_rate(const FallChange& change) const {
  const Vector3 phi = change.segment<3>(4);
  const Instant instant = falling(
      nav::canonical(q_nv_.value()) * nav::quaternion_from_rotation_vector(phi), speed_m_per_s_.value() + change[3],
      {latitude_rad_.value() + change[0], longitude_rad_.value() + change[1], height_m_.value() + change[2]});
  const Vector3& omega_nv_v = instant.motion.omega_nv_v;
  FallChange rate;
  rate << instant.position_rate, along_v_.dot(instant.motion.a_lin_v),
      omega_nv_v + 0.5 * phi.cross(omega_nv_v) + phi.cross(phi.cross(omega_nv_v)) / 12.0,
      omega_nv_v + instant.omega_in_v, drag_v(instant);
  return rate;
}

/// From axes that do not spin, in which now_ is, to those of the vehicle.
void VehicleMotion::spin_to(double t_s) {
  const Spin& spin = segment_.spin();
  if (spin.is_none()) return;
  spun_ = nav::quaternion_from_rotation_vector(std::remainder(spin.angle_rad(t_s), 2.0 * units::kPi) * along_v_);
  const Matrix3 C_vu = spun_.conjugate().toRotationMatrix();
  now_.C_nv = now_.C_nv * C_vu.transpose();
  now_.motion.omega_nv_v = C_vu * now_.motion.omega_nv_v + spin.rate_rad_per_s(t_s) * along_v_;
  now_.omega_in_v = C_vu * now_.omega_in_v;
  now_.f_earth_v = C_vu * now_.f_earth_v;
}

void VehicleMotion::fall(double t0_s, double t1_s, double dt_s) {
  const FallChange k1 = fall_rate(FallChange::Zero());
  const FallChange k2 = fall_rate(0.5 * dt_s * k1);
  const FallChange k3 = fall_rate(0.5 * dt_s * k2);
  const FallChange k4 = fall_rate(dt_s * k3);
  const FallChange change = dt_s / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
  add_to_position(change.head<3>());
  speed_m_per_s_.add(change[3]);
  q_nv_.turn_source(change.segment<3>(4));
  const Spin& spin = segment_.spin();
  if (spin.is_none()) {
    increments_.dtheta_v += change.segment<3>(7);
  } else {
    increments_.dtheta_v += spin.integral_in_spinning_axes(along_v_, k1.segment<3>(7), 0.5 * (k2 + k3).segment<3>(7),
                                                           k4.segment<3>(7), t0_s, dt_s) +
                            spin.turned_rad(t0_s, dt_s) * along_v_;
  }
  increments_.dv_v += change.tail<3>();
  now_ = falling(nav::canonical(q_nv_.value()), speed_m_per_s_.value(), position());
  spin_to(t1_s);
}

void VehicleMotion::evaluate(Instant& instant, const nav::Geodetic& position) const {
  using namespace nav::wgs84;
  const double s = std::sin(position.latitude_rad), c = std::cos(position.latitude_rad), height_m = position.height_m;
  const double inverse_w2 = 1.0 / (1.0 - e2 * s * s);
  const double N = a_m * std::sqrt(inverse_w2);
  const double M = N * (1.0 - e2) * inverse_w2;
  const Vector3& v_n = instant.v_n;
  instant.inverse_north_m = 1.0 / (M + height_m);
  const double east_rate = v_n.y() / (N + height_m);
  const double longitude_rate = east_rate / c;
  const double latitude_rate = v_n.x() * instant.inverse_north_m;
  instant.position_rate = {latitude_rate, longitude_rate, -v_n.z()};

  const Vector3 omega_ie_n(omega_e_rad_per_s * c, 0.0, -omega_e_rad_per_s * s);
  const Vector3 omega_en_n(east_rate, -latitude_rate, -longitude_rate * s);
  const Matrix3 C_vn = instant.C_nv.transpose();
  const Vector3 g_n = gravity_.g_n(s, height_m, [&position] { return position; });
  instant.omega_in_v = C_vn * (omega_ie_n + omega_en_n);
  instant.f_earth_v = C_vn * ((2.0 * omega_ie_n + omega_en_n).cross(v_n) - g_n);
}

void VehicleMotion::add_to_position(const Vector3& change) {
  latitude_rad_.add(change.x());
  longitude_rad_.add(change.y());
  height_m_.add(change.z());
  if (std::abs(longitude_rad_.value()) > units::kPi) {
    const double turn = longitude_rad_.value() > 0.0 ? -2.0 : 2.0;
    longitude_rad_.add(turn * units::kPi);
    longitude_rad_.add(turn * kRoundingOfPi);
  }
}

Increments VehicleMotion::take_increments() { return std::exchange(increments_, Increments{}); }

nav::Geodetic VehicleMotion::position() const {
  return {latitude_rad_.value(), longitude_rad_.value(), height_m_.value()};
}

Quaternion VehicleMotion::q_nv() const {
  return nav::canonical(segment_.spin().is_none() ? q_nv_.value() : q_nv_.value() * spun_);
}

}  // namespace inslab::trajectory
