#include "services/trajectory_server/waypoint_motion.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "scenario/waypoint_route.hpp"
#include "services/trajectory_server/path_attitude.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;
constexpr double kFarthest_rad = 2.0 * kRadPerDeg;
constexpr time::Nanoseconds kFarthest{10000000000};
constexpr time::Nanoseconds kNearest{10000000};
constexpr time::Nanoseconds kFirstOfWait{100000000};

class RoutePath final : public Path {
 public:
  explicit RoutePath(scenario::WaypointRoute route) : route_(std::move(route)) {}

  std::size_t pieces() const override { return route_.pieces(); }
  PathPiece piece(std::size_t index) const override { return route_.piece(index); }

 private:
  scenario::WaypointRoute route_;
};

/// Chooses the instants whose attitudes the rotation spline goes through.
class AttitudeSampler {
 public:
  explicit AttitudeSampler(double max_bank_rad) : max_bank_rad_(max_bank_rad) {}

  void add(const PathPiece& piece) {
    if (times_.empty()) keep(piece.start, attitude(piece, piece.start));
    const bool waits = piece.law.first(0.0) == 0.0 && piece.law.first(time::to_seconds(piece.end - piece.start)) == 0.0;
    if (waits) {
      add_wait(piece);
    } else {
      halve(piece, piece.start, q_ev_.back(), piece.end, attitude(piece, piece.end));
    }
  }

  std::unique_ptr<const AttitudeCurve> take() {
    return std::make_unique<AttitudeCurve>(std::move(times_), std::move(q_ev_));
  }

 private:
  void keep(time::Nanoseconds instant, const nav::Quaternion& q_ev) {
    times_.push_back(instant);
    q_ev_.push_back(q_ev);
  }

  /// Keeps what is needed between two instants, and the second.
  void halve(const PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
             const nav::Quaternion& q1) {
    const time::Nanoseconds middle = (t0 + t1) / 2;
    const nav::Quaternion q_middle = attitude(piece, middle);
    const bool far = t1 - t0 > kFarthest || nav::angle_between(q0, q_middle) > 0.5 * kFarthest_rad ||
                     nav::angle_between(q_middle, q1) > 0.5 * kFarthest_rad;
    if (far && t1 - t0 > kNearest) {
      halve(piece, t0, q0, middle, q_middle);
      halve(piece, middle, q_middle, t1, q1);
    } else {
      keep(t1, q1);
    }
  }

  /// Intervals that grow from both ends: what is left of the motion's rate dies away within the first few.
  void add_wait(const PathPiece& piece) {
    const nav::Quaternion q_ev = q_ev_.back();
    std::vector<time::Nanoseconds> from_end;
    const time::Nanoseconds half = (piece.end - piece.start) / 2;
    for (time::Nanoseconds t = kFirstOfWait; t < half; t *= 2) {
      keep(piece.start + t, q_ev);
      from_end.push_back(piece.end - t);
    }
    for (std::size_t i = from_end.size(); i-- > 0;) keep(from_end[i], q_ev);
    keep(piece.end, q_ev);
  }

  nav::Quaternion attitude(const PathPiece& piece, time::Nanoseconds instant) {
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

  static constexpr double kVertical = 1e-6;

  double max_bank_rad_;
  double yaw_rad_ = 0.0;
  std::vector<time::Nanoseconds> times_;
  std::vector<nav::Quaternion> q_ev_;
};

}  // namespace

SmoothMotion motion_along_waypoints(const scenario::Trajectory& trajectory, time::Nanoseconds end) {
  if (const auto broken = scenario::violation(trajectory)) {
    throw std::invalid_argument("trajectory." + broken->path + " " + broken->reason);
  }
  scenario::WaypointRoute route(trajectory.waypoints);
  if (trajectory.waypoints.back().speed_m_per_s == 0.0) route.stay_until(end);
  AttitudeSampler attitudes(trajectory.attitude_from_path.max_bank_deg * kRadPerDeg);
  for (std::size_t i = 0; i < route.pieces(); ++i) attitudes.add(route.piece(i));
  SmoothMotion motion;
  motion.attitude = attitudes.take();
  motion.path = std::make_unique<RoutePath>(std::move(route));
  return motion;
}

}  // namespace inslab::trajectory
