#include "inslab/models/trajectory/waypoint_motion.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/attitude_sampler.hpp"
#include "inslab/models/trajectory/path_attitude.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/scenario/waypoint_route.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kFarthest_rad = 2.0 * units::kDeg;
constexpr time::Nanoseconds kFarthest{10000000000};

constexpr JumpWords kJumpOfRoute{
    "waypoint",
    "a smoother path, or attitude_from_path.vehicle_class multirotor for one that climbs from its "
    "pad"};

class RoutePath final : public Path {
 public:
  explicit RoutePath(scenario::WaypointRoute route) : route_(std::move(route)) {}

  std::size_t pieces() const override { return route_.pieces(); }
  PathPiece piece(std::size_t index) const override { return route_.piece(index); }

 private:
  scenario::WaypointRoute route_;
};

class NoseAlongTrack final : public AttitudeLaw {
 public:
  explicit NoseAlongTrack(double max_bank_rad) : max_bank_rad_(max_bank_rad) {}

  bool rests(const PathPiece& piece) const override { return waits(piece); }

  bool far(const PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
           const nav::Quaternion& q1) override {
    const nav::Quaternion q_middle = q_ev(piece, (t0 + t1) / 2);
    return t1 - t0 > kFarthest || nav::angle_between(q0, q_middle) > 0.5 * kFarthest_rad ||
           nav::angle_between(q_middle, q1) > 0.5 * kFarthest_rad;
  }

  nav::Quaternion q_ev(const PathPiece& piece, time::Nanoseconds instant) override {
    const double t_s = time::to_seconds(instant - piece.start);
    const double u = piece.law.value(t_s);
    const nav::Geodetic& origin = piece.curve.origin;
    const nav::Geodetic here = nav::displaced(origin, piece.curve.displacement_k(u));
    const nav::Matrix3 C_en = nav::C_en(here.latitude_rad, here.longitude_rad);
    const nav::Matrix3 C_nk = C_en.transpose() * nav::C_en(origin.latitude_rad, origin.longitude_rad);
    const nav::Vector3 along_n = C_nk * piece.curve.first_k(u);
    const double level = std::hypot(along_n.x(), along_n.y());
    if (level > kVertical * along_n.norm()) yaw_rad_ = std::atan2(along_n.y(), along_n.x());
    const double bank_rad =
        bank_of_turn_rad({C_nk * piece.velocity_k(t_s), C_nk * piece.acceleration_k(t_s)}, max_bank_rad_);
    return nav::quaternion_from_matrix(C_en) *
           nav::quaternion_from_rpy({bank_rad, std::atan2(-along_n.z(), level), yaw_rad_});
  }

 private:
  static constexpr double kVertical = 1e-6;

  double max_bank_rad_;
  double yaw_rad_ = 0.0;
};

std::unique_ptr<AttitudeLaw> law_of(const scenario::Trajectory& trajectory, const scenario::WaypointRoute& route,
                                    const nav::Gravity& gravity) {
  const scenario::VehicleAttitude& attitude = trajectory.attitude_from_path;
  if (attitude.vehicle_class == scenario::VehicleClass::NoseAlongTrack) {
    return std::make_unique<NoseAlongTrack>(attitude.max_bank_deg * units::kDeg);
  }
  return std::make_unique<ClassAttitude>(
      attitude, YawSchedule(attitude.yaw_deg * units::kDeg, trajectory.waypoints, route), gravity);
}

}  // namespace

SmoothMotion motion_along_waypoints(const scenario::Trajectory& trajectory, time::Nanoseconds end,
                                    const nav::Gravity& gravity) {
  if (const auto broken = scenario::violation(trajectory)) {
    throw std::invalid_argument("trajectory." + broken->path + " " + broken->reason);
  }
  scenario::WaypointRoute route(trajectory.waypoints, scenario::route_options(trajectory));
  if (trajectory.waypoints.back().speed_m_per_s == 0.0) route.stay_until(end);
  const std::unique_ptr<AttitudeLaw> law = law_of(trajectory, route, gravity);
  SmoothMotion motion;
  motion.path = std::make_unique<RoutePath>(std::move(route));
  motion.attitude = sampled_attitude(*motion.path, *law, kJumpOfRoute, end);
  motion.heave = heave_of(trajectory.attitude_from_path);
  return motion;
}

}  // namespace inslab::trajectory
