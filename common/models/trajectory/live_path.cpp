#include "inslab/models/trajectory/live_path.hpp"

#include <cmath>

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/rotation_rate.hpp"

namespace inslab::trajectory {

namespace {

// (1 + x + x^2/2) e^-x = 0.01
constexpr double kDecaysInReturnTime = 8.4059;

/// The cubic with these values and rates at 0 and at `T_s`.
VectorPolynomial<3> cubic(const std::array<Vector3, 2>& start, const std::array<Vector3, 2>& end, double T_s) {
  const Vector3 value = (end[0] - start[0]) - T_s * start[1];
  const Vector3 rate = T_s * (end[1] - start[1]);
  return {{start[0], start[1], (3.0 * value - rate) / (T_s * T_s), (rate - 2.0 * value) / (T_s * T_s * T_s)}};
}

/// Acceleration relative to the Earth in e, from the derivative of v_n: the frame n itself turns.
Vector3 a_e(const VehicleKnot& knot, const Matrix3& C_en) {
  return C_en * (knot.a_n + nav::omega_en_n(knot.position, knot.v_n).cross(knot.v_n));
}

Vector3 rotation_vector_between(const Quaternion& from, const Quaternion& to) {
  return nav::rotation_vector_from_quaternion(from.conjugate() * to);
}

}  // namespace

template <std::size_t n>
Vector3 VectorPolynomial<n>::value(double t_s) const {
  Vector3 sum = coefficients[n];
  for (std::size_t i = n; i-- > 0;) sum = sum * t_s + coefficients[i];
  return sum;
}

template <std::size_t n>
Vector3 VectorPolynomial<n>::rate(double t_s) const {
  Vector3 sum = static_cast<double>(n) * coefficients[n];
  for (std::size_t i = n; i-- > 1;) sum = sum * t_s + static_cast<double>(i) * coefficients[i];
  return sum;
}

template <std::size_t n>
Vector3 VectorPolynomial<n>::second_rate(double t_s) const {
  Vector3 sum = static_cast<double>(n * (n - 1)) * coefficients[n];
  for (std::size_t i = n; i-- > 2;) sum = sum * t_s + static_cast<double>(i * (i - 1)) * coefficients[i];
  return sum;
}

LivePathPiece::LivePathPiece(const VehicleKnot& from)
    : start_(from.time),
      origin_(from.position),
      C_en_(nav::C_en(from.position.latitude_rad, from.position.longitude_rad)),
      q_nv_(from.q_nv) {}

LivePathPiece LivePathPiece::between(const VehicleKnot& from, const VehicleKnot& to) {
  LivePathPiece piece(from);
  const double T_s = time::to_seconds(to.time - from.time);
  const Matrix3 C_en_to = nav::C_en(to.position.latitude_rad, to.position.longitude_rad);
  const VectorPolynomial<3> v_e =
      cubic({piece.C_en_ * from.v_n, a_e(from, piece.C_en_)}, {C_en_to * to.v_n, a_e(to, C_en_to)}, T_s);
  const auto& c = v_e.coefficients;
  piece.r_e_ = {{Vector3::Zero(), c[0], c[1] / 2.0, c[2] / 3.0, c[3] / 4.0}};
  const Vector3 whole = rotation_vector_between(from.q_nv, to.q_nv);
  piece.Phi_ = cubic({Vector3::Zero(), from.omega_nv_v}, {whole, nav::rotation_vector_rate(whole, to.omega_nv_v)}, T_s);
  return piece;
}

LivePathPiece LivePathPiece::beyond(const VehicleKnot& from, double fading_s) {
  LivePathPiece piece(from);
  const Vector3 a = a_e(from, piece.C_en_);
  const Vector3 zero = Vector3::Zero();
  const double f = fading_s;
  piece.r_e_ = {{zero, piece.C_en_ * from.v_n, 0.5 * a, -a / (3.0 * f), a / (12.0 * f * f)}};
  const Vector3& omega = from.omega_nv_v;
  piece.Phi_ = {{zero, omega, -omega / f, omega / (3.0 * f * f)}};
  return piece;
}

LivePathPoint LivePathPiece::at(double since_start_s) const {
  LivePathPoint point;
  point.r_e = r_e_.value(since_start_s);
  point.v_e = r_e_.rate(since_start_s);
  point.a_e = r_e_.second_rate(since_start_s);
  const Vector3 Phi = Phi_.value(since_start_s);
  point.q_nv = q_nv_ * nav::quaternion_from_rotation_vector(Phi);
  point.omega_nv_v = nav::rate_from_rotation_vector(Phi, Phi_.rate(since_start_s));
  return point;
}

LivePathOffset::LivePathOffset(double return_time_s)
    : k_(kDecaysInReturnTime / return_time_s),
      r_e_{{Vector3::Zero(), Vector3::Zero(), Vector3::Zero()}},
      Phi_{{Vector3::Zero(), Vector3::Zero()}} {}

void LivePathOffset::begin(time::Nanoseconds start, const LivePathPoint& is, const LivePathPoint& should_be) {
  start_ = start;
  const Vector3 r = is.r_e - should_be.r_e, v = is.v_e - should_be.v_e, a = is.a_e - should_be.a_e;
  r_e_ = {{r, v + k_ * r, 0.5 * a + k_ * (v + 0.5 * k_ * r)}};
  // is.q = should_be.q * exp(Phi): its rate is the other's, seen from the turned axes, plus that of exp(Phi).
  const Vector3 Phi = rotation_vector_between(should_be.q_nv, is.q_nv);
  const Quaternion turned = nav::quaternion_from_rotation_vector(Phi);
  const Vector3 omega = is.omega_nv_v - turned.conjugate() * should_be.omega_nv_v;
  Phi_ = {{Phi, nav::rotation_vector_rate(Phi, omega) + k_ * Phi}};
}

LivePathPoint LivePathOffset::added_to(const LivePathPoint& point, double since_start_s) const {
  const double left = std::exp(-k_ * since_start_s);
  LivePathPoint sum = point;
  const Vector3 r = r_e_.value(since_start_s), v = r_e_.rate(since_start_s), a = r_e_.second_rate(since_start_s);
  sum.r_e += left * r;
  sum.v_e += left * (v - k_ * r);
  sum.a_e += left * (a - k_ * (2.0 * v - k_ * r));
  const Vector3 polynomial = Phi_.value(since_start_s);
  const Vector3 Phi = left * polynomial;
  const Vector3 Phi_rate = left * (Phi_.rate(since_start_s) - k_ * polynomial);
  const Quaternion turned = nav::quaternion_from_rotation_vector(Phi);
  sum.q_nv = point.q_nv * turned;
  sum.omega_nv_v = turned.conjugate() * point.omega_nv_v + nav::rate_from_rotation_vector(Phi, Phi_rate);
  return sum;
}

}  // namespace inslab::trajectory
