#include "services/inslab/track_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/error.hpp"
#include "io/mcap_reader.hpp"
#include "services/trajectory_server/truth_source.hpp"
#include "wire/cdr.hpp"
#include "wire/topic_names.hpp"
#include "wire/wire_type.hpp"

namespace inslab::cli {

namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr std::size_t kMostPoints = 40000;
constexpr std::size_t kBins = 300;            // of a curve over time: a pixel or two each
constexpr double kFinestTrack = 1.0 / 600.0;  // of the track's extent: a pixel

/// Where an angle turns over, the curve is interrupted.
void interrupt_at_turnover(io::Curve& curve) {
  io::Curve broken{curve.title, {}, {}, curve.style};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (i > 0 && std::abs(curve.y[i] - curve.y[i - 1]) > 180.0) {
      broken.x.push_back(curve.x[i]);
      broken.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    broken.x.push_back(curve.x[i]);
    broken.y.push_back(curve.y[i]);
  }
  curve = broken;
}

}  // namespace

void Track::add(const TruthState& truth) {
  if (added_++ % keep_every_ != 0) return;
  points_.push_back({static_cast<double>(truth.header.sim_time_ns) * 1e-9,
                     {truth.latitude_rad, truth.longitude_rad, truth.height_m},
                     truth.v_n.norm(),
                     nav::rpy_from_quaternion(truth.q_nv)});
  if (points_.size() < kMostPoints) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  keep_every_ *= 2;
}

io::Curve Track::over_time(const std::string& title, double (*value)(const Point&)) const {
  io::Curve curve;
  curve.title = title;
  for (const Point& point : points_) {
    curve.x.push_back(point.t_s);
    curve.y.push_back(value(point));
  }
  return io::thinned(curve, kBins);
}

io::Panel Track::ground_panel() const {
  io::Curve track;
  double extent_m = 0.0;
  for (const Point& point : points_) {
    const Vector3 ned_m = nav::ned_from(points_.front().position, point.position);
    track.x.push_back(ned_m.y());
    track.y.push_back(ned_m.x());
    extent_m = std::max({extent_m, std::abs(ned_m.x()), std::abs(ned_m.y())});
  }
  io::Panel panel{"track", "east (m)", "north (m)", {}, true};
  const bool moves = extent_m > 1e-3;
  panel.curves.push_back(moves ? io::thinned_by_distance(track, kFinestTrack * extent_m) : track);
  if (!moves) panel.curves.back() = {"", {0.0}, {0.0}, "points pointtype 7 linecolor rgb '#0060ad'"};
  panel.curves.push_back({"start", {0.0}, {0.0}, "points pointtype 6 linecolor rgb '#c03020'"});
  return panel;
}

io::Panel Track::attitude_panel() const {
  io::Panel panel{"attitude", "time (s)", "deg", {}};
  panel.curves.push_back(over_time("roll", [](const Point& point) { return point.rpy.roll_rad * kDegPerRad; }));
  panel.curves.push_back(over_time("pitch", [](const Point& point) { return point.rpy.pitch_rad * kDegPerRad; }));
  panel.curves.push_back(over_time("yaw", [](const Point& point) { return point.rpy.yaw_rad * kDegPerRad; }));
  for (io::Curve& curve : panel.curves) interrupt_at_turnover(curve);
  return panel;
}

io::Picture Track::picture(const std::string& title) const {
  io::Picture picture;
  picture.title = title;
  picture.columns = 2;
  const auto height = over_time("", [](const Point& point) { return point.position.height_m; });
  const auto speed = over_time("", [](const Point& point) { return point.speed_m_per_s; });
  picture.panels = {ground_panel(),
                    {"height above the ellipsoid", "time (s)", "m", {height}},
                    {"speed", "time (s)", "m/s", {speed}},
                    attitude_panel()};
  return picture;
}

Track track_of_scenario(const scenario::LoadedScenario& scenario) {
  if (scenario.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw io::ReadError(scenario.file.string() + ": follows a live vehicle: its track is in the log of a run");
  }
  trajectory::TruthSource source(scenario, {0, 0}, RunId{});
  Track track;
  while (source.has_next()) track.add(source.take());
  return track;
}

Track track_of_log(const std::string& log_path) {
  const io::McapReader log(log_path);
  Track track;
  log.for_each([&](const io::mcap::Message& message) {
    if (log.channels().at(message.channel_id).topic != wire::topic_names::kTruth) return true;
    TruthState truth;
    if (wire::decode(message.data, message.size, truth)) track.add(truth);
    return true;
  });
  if (track.empty()) throw io::ReadError(log_path + ": has no " + std::string(wire::topic_names::kTruth));
  return track;
}

}  // namespace inslab::cli
