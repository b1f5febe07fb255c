#include "inslab/models/trajectory/waypoint_motion.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/path_attitude.hpp"
#include "inslab/models/trajectory/vehicle_attitude.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/scenario/waypoint_route.hpp"

namespace inslab::trajectory {

namespace {

constexpr double kFarthest_rad = 2.0 * units::kDeg;
constexpr time::Nanoseconds kFarthest{10000000000};
constexpr time::Nanoseconds kNearest{10000000};
constexpr time::Nanoseconds kFirstOfWait{100000000};
// What a nose that follows its path may turn within kNearest: 1100 deg/s.
constexpr double kJump_rad = 0.2;

class RoutePath final : public Path {
 public:
  explicit RoutePath(scenario::WaypointRoute route) : route_(std::move(route)) {}

  std::size_t pieces() const override { return route_.pieces(); }
  PathPiece piece(std::size_t index) const override { return route_.piece(index); }

 private:
  scenario::WaypointRoute route_;
};

/// The attitudes that a class asks for, and how near to each other the rotation spline needs them.
class AttitudeLaw {
 public:
  AttitudeLaw() = default;
  AttitudeLaw(const AttitudeLaw&) = delete;
  AttitudeLaw& operator=(const AttitudeLaw&) = delete;
  virtual ~AttitudeLaw() = default;

  virtual nav::Quaternion q_ev(const PathPiece& piece, time::Nanoseconds instant) = 0;
  /// Whether it stays as it is while the vehicle waits on this piece.
  virtual bool rests(const PathPiece& piece) const = 0;
  /// Whether two attitudes at these instants are too far apart.
  virtual bool far(const PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
                   const nav::Quaternion& q1) = 0;
  /// Whether neighbouring intervals must be of like length. Where the law's angular acceleration jumps, at the ends of
  /// a ramp, a spline swings beside it; in a long interval beside a short one it would swing far.
  virtual bool is_graded() const { return false; }

 protected:
  static bool waits(const PathPiece& piece) {
    return piece.law.first(0.0) == 0.0 && piece.law.first(time::to_seconds(piece.end - piece.start)) == 0.0 &&
           piece.law.first(0.5 * time::to_seconds(piece.end - piece.start)) == 0.0;
  }
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

/// The other classes, whose attitude is a function of the path at an instant and of the time.
class ClassAttitude final : public AttitudeLaw {
 public:
  ClassAttitude(const scenario::Trajectory& trajectory, const scenario::WaypointRoute& route,
                const nav::Gravity& gravity)
      : attitude_(trajectory.attitude_from_path), yaw_(trajectory.waypoints, route), gravity_(gravity) {
    const double shortest_s = std::min(attitude_.roll_period_s, attitude_.pitch_period_s);
    if (sways()) farthest_ = std::min(farthest_, time::from_seconds(shortest_s / kPointsOfPeriod));
  }

  bool is_graded() const override { return true; }

  bool rests(const PathPiece& piece) const override {
    return waits(piece) && !sways() && !yaw_.turns_between(piece.start, piece.end);
  }

  bool far(const PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
           const nav::Quaternion& q1) override {
    if (t1 - t0 > farthest_) return true;
    for (int i = 1; i <= 3; ++i) {
      const nav::Quaternion here = q_ev(piece, t0 + i * (t1 - t0) / 4);
      if (nav::angle_between(q0.slerp(0.25 * i, q1), here) > kOffArc_rad) return true;
    }
    return false;
  }

  nav::Quaternion q_ev(const PathPiece& piece, time::Nanoseconds instant) override {
    const PathInstant here = path_instant(piece, time::to_seconds(instant - piece.start), gravity_);
    return nav::quaternion_from_matrix(here.C_en * C_nv(here, instant));
  }

 private:
  static constexpr double kOffArc_rad = 2e-5;
  static constexpr double kPointsOfPeriod = 64.0;

  bool sways() const {
    return attitude_.vehicle_class == scenario::VehicleClass::Ship &&
           (attitude_.roll_amplitude_deg > 0.0 || attitude_.pitch_amplitude_deg > 0.0);
  }

  nav::Matrix3 C_nv(const PathInstant& here, time::Nanoseconds instant) const {
    const double t_s = time::to_seconds(instant);
    const auto wave = [&](double amplitude_deg, double period_s) {
      return units::kDeg * amplitude_deg * std::sin(2.0 * units::kPi * t_s / period_s);
    };
    switch (attitude_.vehicle_class) {
      case scenario::VehicleClass::Multirotor:
        return attitude_of_thrust(here.f_n + attitude_.drag_per_s * here.v_n, yaw_.at(instant));
      case scenario::VehicleClass::FixedWing:
        return attitude_of_lift(here, units::kDeg * attitude_.max_bank_deg,
                                share_of_flight(here.v_n.norm(), attitude_.lift_off_speed_m_per_s),
                                units::kDeg * attitude_.angle_of_attack_deg);
      case scenario::VehicleClass::Ship:
      case scenario::VehicleClass::NoseAlongTrack:
        break;
    }
    return nav::matrix_from_rpy({wave(attitude_.roll_amplitude_deg, attitude_.roll_period_s),
                                 wave(attitude_.pitch_amplitude_deg, attitude_.pitch_period_s),
                                 std::atan2(here.along_n.y(), here.along_n.x())});
  }

  scenario::VehicleAttitude attitude_;
  YawSchedule yaw_;
  nav::Gravity gravity_;
  time::Nanoseconds farthest_{1000000000};
};

/// Chooses the instants whose attitudes the rotation spline goes through.
class AttitudeSampler {
 public:
  explicit AttitudeSampler(AttitudeLaw& law) : law_(law) {}

  void add(const PathPiece& piece) {
    pieces_.push_back(piece);
    if (knots_.empty()) keep(piece.start, law_.q_ev(piece, piece.start));
    if (law_.rests(piece)) {
      add_wait(piece);
    } else {
      halve(piece, piece.start, knots_.back().q_ev, piece.end, law_.q_ev(piece, piece.end));
    }
  }

  std::unique_ptr<const AttitudeCurve> take() {
    while (law_.is_graded() && halve_beside_shorter()) continue;
    std::vector<time::Nanoseconds> times;
    std::vector<nav::Quaternion> q_ev;
    for (const Knot& knot : knots_) {
      times.push_back(knot.instant);
      q_ev.push_back(knot.q_ev);
    }
    return std::make_unique<AttitudeCurve>(std::move(times), std::move(q_ev));
  }

 private:
  struct Knot {
    time::Nanoseconds instant;
    nav::Quaternion q_ev;
    std::size_t piece;  ///< that leads to it
  };

  void keep(time::Nanoseconds instant, const nav::Quaternion& q_ev) {
    knots_.push_back({instant, q_ev, pieces_.size() - 1});
  }

  /// Halves each interval that is more than twice as long as one beside it; false when there is none.
  bool halve_beside_shorter() {
    const auto length = [this](std::size_t k) { return knots_[k].instant - knots_[k - 1].instant; };
    std::vector<Knot> finer{knots_.front()};
    for (std::size_t k = 1; k < knots_.size(); ++k) {
      const bool before = k > 1 && length(k) > 2 * length(k - 1);
      const bool after = k + 1 < knots_.size() && length(k) > 2 * length(k + 1);
      if (before || after) {
        const time::Nanoseconds middle = knots_[k - 1].instant + length(k) / 2;
        finer.push_back({middle, law_.q_ev(pieces_[knots_[k].piece], middle), knots_[k].piece});
      }
      finer.push_back(knots_[k]);
    }
    const bool is_finer = finer.size() > knots_.size();
    knots_ = std::move(finer);
    return is_finer;
  }

  /// Keeps what is needed between two instants, and the second.
  void halve(const PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
             const nav::Quaternion& q1) {
    const bool far = law_.far(piece, t0, q0, t1, q1);
    if (far && t1 - t0 > kNearest) {
      const time::Nanoseconds middle = (t0 + t1) / 2;
      const nav::Quaternion q_middle = law_.q_ev(piece, middle);
      halve(piece, t0, q0, middle, q_middle);
      halve(piece, middle, q_middle, t1, q1);
      return;
    }
    if (t1 - t0 <= kNearest && nav::angle_between(q0, q1) > kJump_rad) {
      std::ostringstream why;
      why << "the nose turns by " << nav::angle_between(q0, q1) / units::kDeg << " deg within "
          << time::to_seconds(t1 - t0) << " s at " << time::to_seconds(t0) << " s, on the way from waypoint "
          << piece.index << ": a vehicle that follows its nose cannot; expected a smoother path, or "
          << "attitude_from_path.vehicle_class multirotor for one that climbs from its pad";
      throw std::domain_error(why.str());
    }
    keep(t1, q1);
  }

  /// Intervals that grow from both ends: what is left of the motion's rate dies away within the first few.
  void add_wait(const PathPiece& piece) {
    const nav::Quaternion q_ev = knots_.back().q_ev;
    std::vector<time::Nanoseconds> from_end;
    const time::Nanoseconds half = (piece.end - piece.start) / 2;
    for (time::Nanoseconds t = kFirstOfWait; t < half; t *= 2) {
      keep(piece.start + t, q_ev);
      from_end.push_back(piece.end - t);
    }
    for (std::size_t i = from_end.size(); i-- > 0;) keep(from_end[i], q_ev);
    keep(piece.end, q_ev);
  }

  AttitudeLaw& law_;
  std::vector<PathPiece> pieces_;
  std::vector<Knot> knots_;
};

std::unique_ptr<AttitudeLaw> law_of(const scenario::Trajectory& trajectory, const scenario::WaypointRoute& route,
                                    const nav::Gravity& gravity) {
  const scenario::VehicleAttitude& attitude = trajectory.attitude_from_path;
  if (attitude.vehicle_class == scenario::VehicleClass::NoseAlongTrack) {
    return std::make_unique<NoseAlongTrack>(attitude.max_bank_deg * units::kDeg);
  }
  return std::make_unique<ClassAttitude>(trajectory, route, gravity);
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
  AttitudeSampler attitudes(*law);
  for (std::size_t i = 0; i < route.pieces(); ++i) attitudes.add(route.piece(i));
  SmoothMotion motion;
  motion.attitude = attitudes.take();
  motion.path = std::make_unique<RoutePath>(std::move(route));
  return motion;
}

}  // namespace inslab::trajectory
