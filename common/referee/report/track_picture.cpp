#include "inslab/referee/report/track_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/sim/truth_source.hpp"

namespace inslab::report {

namespace {

constexpr std::size_t kMostSamples = 40000;
constexpr std::size_t kTrackBins = 140;       // of a curve over time: a pixel or two each
constexpr double kFinestTrack = 1.0 / 600.0;  // of the track's extent: a pixel
constexpr std::size_t kMostTrackPoints = 800;
constexpr double kStandsWithin_m = 1e-3;

/// An angle over time, thinned; interrupted where it turns over.
tables::Curve thinned_angle(const tables::Curve& curve) {
  tables::Curve joined{curve.title, {}, {}, curve.style};
  const auto place = [](std::vector<double>::size_type i) { return static_cast<std::ptrdiff_t>(i); };
  std::size_t begin = 0;
  for (std::size_t end = 1; end <= curve.x.size(); ++end) {
    if (end < curve.x.size() && std::abs(curve.y[end] - curve.y[end - 1]) <= 180.0) continue;
    tables::Curve stretch;
    stretch.x.assign(curve.x.begin() + place(begin), curve.x.begin() + place(end));
    stretch.y.assign(curve.y.begin() + place(begin), curve.y.begin() + place(end));
    stretch = tables::thinned(stretch, 2 + kTrackBins * (end - begin) / curve.x.size());
    if (begin > 0) {
      joined.x.push_back(stretch.x.front());
      joined.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    joined.x.insert(joined.x.end(), stretch.x.begin(), stretch.x.end());
    joined.y.insert(joined.y.end(), stretch.y.begin(), stretch.y.end());
    begin = end;
  }
  return joined;
}

}  // namespace

void Track::add(const TruthState& truth) {
  if (added_++ % keep_every_ != 0) return;
  points_.push_back({time::to_seconds(truth.header.sim_time_ns), geodetic_of(truth), truth.v_n.norm(),
                     nav::rpy_from_quaternion(truth.q_nv)});
  if (points_.size() < kMostSamples) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  keep_every_ *= 2;
}

tables::Curve Track::over_time(const std::string& title, double (*value)(const Point&)) const {
  tables::Curve curve;
  curve.title = title;
  for (const Point& point : points_) {
    curve.x.push_back(point.t_s);
    curve.y.push_back(value(point));
  }
  return curve;
}

tables::Panel Track::ground_panel() const {
  std::vector<Vector3> ned_m;
  Vector3 low_m = Vector3::Zero(), high_m = Vector3::Zero();
  for (const Point& point : points_) {
    ned_m.push_back(nav::ned_from(points_.front().position, point.position));
    low_m = low_m.cwiseMin(ned_m.back());
    high_m = high_m.cwiseMax(ned_m.back());
  }
  const double extent_m = (high_m - low_m).head<2>().maxCoeff();
  const bool in_km = extent_m >= 2000.0;
  const double per_m = in_km ? 1e-3 : 1.0;
  tables::Curve track;
  for (const Vector3& place : ned_m) {
    track.x.push_back(place.y() * per_m);
    track.y.push_back(place.x() * per_m);
  }
  tables::Panel panel;
  panel.title = "track from its start (circle)";
  panel.x_label = in_km ? "east (km)" : "east (m)";
  panel.y_label = in_km ? "north (km)" : "north (m)";
  panel.equal_scales = true;
  if (extent_m > kStandsWithin_m) {
    panel.tic_step = tables::tic_step_over(extent_m * per_m);
    panel.curves.push_back(tables::thinned_by_distance(track, kFinestTrack * extent_m * per_m, kMostTrackPoints));
  }
  panel.curves.push_back({"", {0.0}, {0.0}, "points pointtype 6 linecolor rgb '#c03020'"});
  return panel;
}

tables::Panel Track::attitude_panel() const {
  tables::Panel panel;
  panel.title = "attitude";
  panel.x_label = "time (s)";
  panel.y_label = "deg";
  panel.curves.push_back(over_time("roll", [](const Point& point) { return point.rpy.roll_rad * units::kDegPerRad; }));
  panel.curves.push_back(
      over_time("pitch", [](const Point& point) { return point.rpy.pitch_rad * units::kDegPerRad; }));
  panel.curves.push_back(over_time("yaw", [](const Point& point) { return point.rpy.yaw_rad * units::kDegPerRad; }));
  for (tables::Curve& curve : panel.curves) curve = thinned_angle(curve);
  return panel;
}

tables::Picture Track::picture(const std::string& title) const {
  tables::Picture picture;
  picture.title = title;
  picture.columns = 2;
  const auto height = over_time("", [](const Point& point) { return point.position.height_m; });
  const auto speed = over_time("", [](const Point& point) { return point.speed_m_per_s; });
  const auto over_time_panel = [](const char* quantity, const char* unit, const tables::Curve& curve) {
    tables::Panel panel;
    panel.title = quantity;
    panel.x_label = "time (s)";
    panel.y_label = unit;
    panel.curves = {tables::thinned(curve, kTrackBins)};
    return panel;
  };
  picture.panels = {ground_panel(), over_time_panel("height above the ellipsoid", "m", height),
                    over_time_panel("speed", "m/s", speed), attitude_panel()};
  return picture;
}

Track track_of_scenario(const scenario::LoadedScenario& scenario) {
  if (scenario.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw files::ReadError(scenario.file.string() + ": follows a live vehicle: its track is in the log of a run");
  }
  sim::TruthSource source(scenario, {0, 0}, RunId{});
  Track track;
  while (source.has_next()) track.add(source.take());
  return track;
}

Track track_of_log(const std::string& log_path) {
  const mcap::McapReader log(log_path);
  Track track;
  log.for_each([&](const mcap::Message& message) {
    if (log.channels().at(message.channel_id).topic != catalog::kTruth.name) return true;
    TruthState truth;
    if (wire::decode(message.data, message.size, truth)) track.add(truth);
    return true;
  });
  if (track.empty()) throw files::ReadError(log_path + ": has no " + std::string(catalog::kTruth.name));
  return track;
}

}  // namespace inslab::report
