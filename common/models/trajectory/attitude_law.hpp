#pragma once

#include <optional>

#include "inslab/models/trajectory/row_nose.hpp"
#include "inslab/models/trajectory/vehicle_attitude.hpp"

namespace inslab::trajectory {

/// The attitudes that a class asks for along a path, and how near to each other the rotation spline needs them.
class AttitudeLaw {
 public:
  AttitudeLaw() = default;
  AttitudeLaw(const AttitudeLaw&) = delete;
  AttitudeLaw& operator=(const AttitudeLaw&) = delete;
  virtual ~AttitudeLaw() = default;

  virtual nav::Quaternion q_ev(const scenario::PathPiece& piece, time::Nanoseconds instant) = 0;
  /// Whether it stays as it is while the vehicle waits on this piece.
  virtual bool rests(const scenario::PathPiece& piece) const = 0;
  /// Whether two attitudes at these instants are too far apart.
  virtual bool far(const scenario::PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0,
                   time::Nanoseconds t1, const nav::Quaternion& q1) = 0;
  /// Whether neighbouring intervals must be of like length. Where the law's angular acceleration jumps, at the ends of
  /// a ramp, a spline swings beside it; in a long interval beside a short one it would swing far.
  virtual bool is_graded() const { return false; }

 protected:
  static bool waits(const scenario::PathPiece& piece);
};

/// The classes whose attitude is a function of the path at an instant and of the time: all but nose_along_track.
class ClassAttitude final : public AttitudeLaw {
 public:
  /// `nose` says where a file's rows point the nose; along waypoints it follows the line. `gravity` is what the thrust
  /// of a multirotor and the wings of an aircraft bear.
  ClassAttitude(const scenario::VehicleAttitude& attitude, YawSchedule yaw, const nav::Gravity& gravity,
                std::optional<RowNose> nose = std::nullopt);

  bool is_graded() const override { return true; }
  bool rests(const scenario::PathPiece& piece) const override;
  bool far(const scenario::PathPiece& piece, time::Nanoseconds t0, const nav::Quaternion& q0, time::Nanoseconds t1,
           const nav::Quaternion& q1) override;
  nav::Quaternion q_ev(const scenario::PathPiece& piece, time::Nanoseconds instant) override;

 private:
  bool sways() const;
  nav::Matrix3 C_nv(const PathInstant& here, time::Nanoseconds instant) const;

  scenario::VehicleAttitude attitude_;
  YawSchedule yaw_;
  nav::Gravity gravity_;
  std::optional<RowNose> nose_;
  time::Nanoseconds farthest_{1000000000};
};

}  // namespace inslab::trajectory
