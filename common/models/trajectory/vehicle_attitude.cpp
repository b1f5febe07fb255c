#include "inslab/models/trajectory/vehicle_attitude.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"

namespace inslab::trajectory {

double smooth_step(double x) {
  const double in = std::clamp(x, 0.0, 1.0);
  return in * in * in * (10.0 + in * (-15.0 + 6.0 * in));
}

PathInstant path_instant(const scenario::PathPiece& piece, double t_s, const nav::Gravity& gravity) {
  const double u = piece.law.value(t_s);
  const nav::Geodetic& origin = piece.curve.origin;
  const nav::Geodetic here = nav::displaced(origin, piece.curve.displacement_k(u));
  PathInstant instant;
  instant.position = here;
  instant.C_en = nav::C_en(here.latitude_rad, here.longitude_rad);
  const nav::Matrix3 C_nk = instant.C_en.transpose() * nav::C_en(origin.latitude_rad, origin.longitude_rad);
  instant.along_n = C_nk * piece.curve.first_k(u);
  instant.v_n = C_nk * piece.velocity_k(t_s);
  instant.a_n = C_nk * piece.acceleration_k(t_s);
  instant.f_n = instant.a_n + 2.0 * nav::omega_ie_n(here.latitude_rad).cross(instant.v_n) - gravity.g_n(here);
  return instant;
}

nav::Matrix3 attitude_of_thrust(const nav::Vector3& thrust_n, double yaw_rad) {
  const nav::Vector3 down = -thrust_n.normalized();
  const nav::Vector3 right_of_yaw(-std::sin(yaw_rad), std::cos(yaw_rad), 0.0);
  const nav::Vector3 nose = right_of_yaw.cross(down).normalized();
  nav::Matrix3 C_nv;
  C_nv << nose, down.cross(nose), down;
  return C_nv;
}

nav::Matrix3 attitude_of_lift(const PathInstant& instant, double max_bank_rad, double share_of_flight,
                              double angle_of_attack_rad) {
  const double level = std::hypot(instant.along_n.x(), instant.along_n.y());
  const nav::RollPitchYaw track{0.0, std::atan2(-instant.along_n.z(), level),
                                std::atan2(instant.along_n.y(), instant.along_n.x())};
  const nav::Vector3 f_track = nav::matrix_from_rpy(track).transpose() * instant.f_n;
  const double bank_rad = std::clamp(std::atan2(f_track.y(), -f_track.z()), -max_bank_rad, max_bank_rad);
  return nav::matrix_from_rpy({share_of_flight * bank_rad, track.pitch_rad, track.yaw_rad}) *
         nav::matrix_from_rpy({0.0, share_of_flight * angle_of_attack_rad, 0.0});
}

double share_of_flight(double speed_m_per_s, double lift_off_speed_m_per_s) {
  if (lift_off_speed_m_per_s == 0.0) return 1.0;
  return smooth_step((speed_m_per_s / lift_off_speed_m_per_s - 1.0) / 0.25);
}

YawSchedule::YawSchedule(double first_rad, const std::vector<scenario::Waypoint>& waypoints,
                         const scenario::WaypointRoute& route)
    : first_rad_(first_rad) {
  if (waypoints.front().yaw_deg) first_rad_ = units::kDeg * *waypoints.front().yaw_deg;
  double yaw_rad = first_rad_;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    if (!waypoints[k].yaw_deg) continue;
    const bool waits = waypoints[k].wait_s > 0.0;
    const double change_rad = nav::wrapped_to_pi(units::kDeg * *waypoints[k].yaw_deg - yaw_rad);
    const time::Nanoseconds start = waits ? route.arrival(k) : route.departure(k - 1);
    const time::Nanoseconds end = waits ? start + time::from_seconds(waypoints[k].wait_s) : route.arrival(k);
    turns_.push_back({start, end, yaw_rad, change_rad});
    yaw_rad += change_rad;
  }
}

double YawSchedule::at(time::Nanoseconds instant) const {
  const auto after = std::upper_bound(turns_.begin(), turns_.end(), instant,
                                      [](time::Nanoseconds t, const Turn& turn) { return t < turn.start; });
  if (after == turns_.begin()) return first_rad_;
  const Turn& turn = *std::prev(after);
  return turn.from_rad + turn.change_rad * smooth_step(time::to_seconds(instant - turn.start) /
                                                       time::to_seconds(turn.end - turn.start));
}

bool YawSchedule::turns_between(time::Nanoseconds start, time::Nanoseconds end) const {
  return std::any_of(turns_.begin(), turns_.end(),
                     [&](const Turn& turn) { return turn.change_rad != 0.0 && turn.start < end && start < turn.end; });
}

}  // namespace inslab::trajectory
