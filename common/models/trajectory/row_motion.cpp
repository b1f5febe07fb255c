#include "inslab/models/trajectory/row_motion.hpp"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/trajectory/attitude_sampler.hpp"
#include "inslab/models/trajectory/path_attitude.hpp"

namespace inslab::trajectory {

namespace {

constexpr JumpWords kJumpOfRows{"row",
                                "smoother rows, attitude_from_path.standstill_speed_m_per_s above their noise, or "
                                "attitude_from_path.vehicle_class multirotor"};

nav::Matrix3 C_en_at(const nav::Geodetic& position) { return nav::C_en(position.latitude_rad, position.longitude_rad); }

/// A piece for every row but the last; the curve's parameter is the time.
class RowPath final : public Path {
 public:
  RowPath(std::vector<time::Nanoseconds> times, nav::PositionSpline spline)
      : times_(std::move(times)), spline_(std::move(spline)) {}

  std::size_t pieces() const override { return spline_.pieces(); }
  PathPiece piece(std::size_t index) const override {
    return {times_[index], times_[index + 1], spline_.piece(index), {{0.0, 1.0}}, static_cast<std::uint32_t>(index)};
  }

 private:
  std::vector<time::Nanoseconds> times_;
  nav::PositionSpline spline_;
};

nav::PositionSpline position_spline(const TrajectoryFile& file) {
  std::vector<nav::Geodetic> points;
  std::vector<double> intervals_s;
  points.reserve(file.rows.size());
  intervals_s.reserve(file.rows.size());
  for (std::size_t k = 0; k < file.rows.size(); ++k) {
    nav::check_domain(file.rows[k].position);
    points.push_back(file.rows[k].position);
    if (k > 0) intervals_s.push_back(time::to_seconds(file.rows[k].time - file.rows[k - 1].time));
  }
  const auto velocity_e = [](const TrajectoryRow& row) -> std::optional<nav::Vector3> {
    if (!row.v_n) return std::nullopt;
    return C_en_at(row.position) * *row.v_n;
  };
  return {std::move(points), std::move(intervals_s), {velocity_e(file.rows.front()), velocity_e(file.rows.back())}};
}

/// Velocity and acceleration at every point of the spline, in the point's n, which is the frame of the piece it begins.
std::vector<PathMotion> motions_at_points(const nav::PositionSpline& spline) {
  std::vector<PathMotion> motions(spline.pieces() + 1);
  for (std::size_t k = 0; k < spline.pieces(); ++k) {
    const nav::PositionPiece piece = spline.piece(k);
    motions[k] = {piece.first_k(0.0), piece.second_k(0.0)};
  }
  const std::size_t last = spline.pieces() - 1;
  const nav::PositionPiece piece = spline.piece(last);
  const nav::Matrix3 C_nk = C_en_at(spline.point(last + 1)).transpose() * C_en_at(piece.origin);
  motions.back() = {C_nk * piece.first_k(spline.interval(last)), C_nk * piece.second_k(spline.interval(last))};
  return motions;
}

/// Through the rows' own attitudes, or those of their path with the nose along it.
std::unique_ptr<const AttitudeCurve> attitude_of_rows(const TrajectoryFile& file,
                                                      const std::vector<time::Nanoseconds>& times,
                                                      const nav::PositionSpline& spline,
                                                      const scenario::VehicleAttitude& attitude) {
  std::vector<nav::RollPitchYaw> rpy;
  if (file.rows.front().rpy) {
    rpy.reserve(file.rows.size());
    for (const TrajectoryRow& row : file.rows) rpy.push_back(row.rpy.value());
  } else {
    rpy = attitudes_along(motions_at_points(spline), attitude);
  }
  std::vector<nav::Quaternion> q_ev;
  q_ev.reserve(file.rows.size());
  for (const TrajectoryRow& row : file.rows) {
    q_ev.push_back(nav::quaternion_from_matrix(C_en_at(row.position)) * nav::quaternion_from_rpy(rpy[q_ev.size()]));
  }
  return std::make_unique<AttitudeCurve>(times, std::move(q_ev));
}

void check_tilt(const Path& path, const scenario::VehicleAttitude& attitude) {
  for (std::size_t k = 0; k < path.pieces(); ++k) {
    const auto excess = scenario::excess_tilt(path.piece(k), attitude);
    if (!excess) continue;
    std::ostringstream why;
    why.precision(4);
    why << "the way from row " << k << " leads into a tilt of " << excess->tilt_deg << " deg at " << excess->at_s
        << " s; expected at most " << attitude.max_tilt_deg
        << " (attitude_from_path.max_tilt_deg): smoother or slower rows";
    throw std::domain_error(why.str());
  }
}

}  // namespace

SmoothMotion motion_through(const TrajectoryFile& file, const scenario::VehicleAttitude& attitude,
                            const nav::Gravity& gravity) {
  if (file.rows.size() < 2) throw std::invalid_argument(file.name + ": a motion needs at least two rows");
  std::vector<time::Nanoseconds> times;
  times.reserve(file.rows.size());
  for (const TrajectoryRow& row : file.rows) times.push_back(row.time);
  try {
    nav::PositionSpline spline = position_spline(file);
    SmoothMotion motion;
    if (file.rows.front().rpy || attitude.vehicle_class == scenario::VehicleClass::NoseAlongTrack) {
      motion.attitude = attitude_of_rows(file, times, spline, attitude);
      motion.path = std::make_unique<RowPath>(std::move(times), std::move(spline));
      return motion;
    }
    ClassAttitude law(attitude, YawSchedule(attitude.yaw_deg * units::kDeg), gravity,
                      RowNose(motions_at_points(spline), attitude));
    motion.path = std::make_unique<RowPath>(std::move(times), std::move(spline));
    check_tilt(*motion.path, attitude);
    motion.attitude = sampled_attitude(*motion.path, law, kJumpOfRows);
    motion.heave = heave_of(attitude);
    return motion;
  } catch (const std::domain_error& error) {
    throw std::domain_error(file.name + ": " + error.what());
  }
}

}  // namespace inslab::trajectory
