#include "inslab/referee/score/true_pose.hpp"

#include <cmath>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::score {

namespace {

Matrix3 C_between(const nav::Geodetic& from, const nav::Geodetic& to) {
  return C_between_ned(std::sin(from.latitude_rad), std::cos(from.latitude_rad), std::sin(to.latitude_rad),
                       std::cos(to.latitude_rad), to.longitude_rad - from.longitude_rad);
}

/// A point of a curve and its derivative by time.
struct Point {
  Vector3 value;
  Vector3 rate;
};

/// The cubic from 0 with rate `r0` to `x1` with rate `r1` in `h_s`.
Point on_cubic(const Vector3& r0, const Vector3& x1, const Vector3& r1, double h_s, double t_s) {
  const Vector3 c2 = (3.0 * x1 / h_s - 2.0 * r0 - r1) / h_s;
  const Vector3 c3 = (r0 + r1 - 2.0 * x1 / h_s) / (h_s * h_s);
  return {t_s * (r0 + t_s * (c2 + t_s * c3)), r0 + t_s * (2.0 * c2 + 3.0 * t_s * c3)};
}

/// omega_nv_v: the rate of the vehicle less that of its NED.
Vector3 rate_in_ned(const TruthState& truth) {
  const nav::Geodetic position = geodetic_of(truth);
  const Vector3 omega_in_n = nav::omega_ie_n(position.latitude_rad) + nav::omega_en_n(position, truth.v_n);
  return truth.omega_iv_v - truth.q_nv.toRotationMatrix().transpose() * omega_in_n;
}

/// Rate of the rotation vector from the rate of the body that it turns, and back; Bortz' equation to second order in
/// the vector, which is one interval's rotation.
Vector3 vector_rate(const Vector3& phi, const Vector3& omega) {
  return omega + 0.5 * phi.cross(omega) + phi.cross(phi.cross(omega)) / 12.0;
}
Vector3 body_rate(const Vector3& phi, const Vector3& phi_rate) {
  return phi_rate - 0.5 * phi.cross(phi_rate) + phi.cross(phi.cross(phi_rate)) / 6.0;
}

}  // namespace

TruthState truth_between(const TruthState& before, const TruthState& after, std::int64_t sim_time_ns) {
  if (sim_time_ns >= after.header.sim_time_ns) return after;
  const double h_s = time::to_seconds(after.header.sim_time_ns - before.header.sim_time_ns);
  const double t_s = time::to_seconds(sim_time_ns - before.header.sim_time_ns);
  if (!(h_s > 0.0) || t_s < 0.0) return before;
  const nav::Geodetic begin = geodetic_of(before), end = geodetic_of(after);
  const Point moved =
      on_cubic(before.v_n, nav::ned_from(begin, end), C_between(begin, end).transpose() * after.v_n, h_s, t_s);
  const nav::Geodetic place = nav::displaced(begin, moved.value);

  const Vector3 whole = nav::rotation_vector_from_quaternion(before.q_nv.conjugate() * after.q_nv);
  const Vector3 rate_before = rate_in_ned(before);
  const Vector3 rate_after =
      after.rate_jump ? Vector3(2.0 * whole / h_s - rate_before) : vector_rate(whole, rate_in_ned(after));
  const Point turned = on_cubic(rate_before, whole, rate_after, h_s, t_s);

  TruthState between = after;
  between.rate_jump = false;
  between.header.sim_time_ns = sim_time_ns;
  between.latitude_rad = place.latitude_rad;
  between.longitude_rad = place.longitude_rad;
  between.height_m = place.height_m;
  between.v_n = C_between(begin, place) * moved.rate;
  between.q_nv = (before.q_nv * nav::quaternion_from_rotation_vector(turned.value)).normalized();
  const Vector3 omega_in_n = nav::omega_ie_n(place.latitude_rad) + nav::omega_en_n(place, between.v_n);
  between.omega_iv_v = body_rate(turned.value, turned.rate) + between.q_nv.toRotationMatrix().transpose() * omega_in_n;
  return between;
}

TruePose true_pose(const TruthState& truth, const Mounting& mounting) {
  const SensorSite site = sensor_site(truth, mounting.lever_arm_v_m);
  return {site.position, site.v_n, (Quaternion(site.C_sn) * truth.q_nv * mounting.q_vb).normalized()};
}

SolutionError error_of(const NavSolution& solution, const TruePose& truth) {
  const nav::Geodetic estimate = geodetic_of(solution);
  return {nav::ned_from(truth.position, estimate), solution.v_n - truth.v_n,
          nav::rotation_vector_from_quaternion(truth.q_n_body * solution.q_n_body.normalized().conjugate())};
}

}  // namespace inslab::score
