#include "services/inslab/report_pictures.hpp"

#include <cmath>
#include <map>

namespace inslab::cli {

namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr std::size_t kMostPoints = 40000;
constexpr std::size_t kBins = 400;  // of a curve over time
constexpr const char* kAxes[] = {"north", "east", "down"};

}  // namespace

void ErrorCurves::add(const score::ScoredSolution& scored) {
  if (added_++ % keep_every_ != 0) return;
  const NavSolution& solution = scored.solution;
  points_.push_back(
      {static_cast<double>(scored.sim_time_ns) * 1e-9,
       {scored.error.position_ned_m, scored.error.velocity_ned_m_per_s, scored.error.phi_rad * kDegPerRad},
       {solution.position_sigma_ned_m, solution.velocity_sigma_ned_m_per_s, solution.attitude_sigma_rad * kDegPerRad},
       scored.truth.position});
  if (points_.size() < kMostPoints) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  keep_every_ *= 2;
}

io::Picture ErrorCurves::errors(std::size_t which, const std::string& title, const std::string& unit,
                                const LogScore& score, const LogSummary& summary) const {
  io::Picture picture;
  picture.title = title;
  picture.panel_width_px = 900;
  picture.panel_height_px = 220;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    io::Curve error{"error", {}, {}, "lines linecolor rgb '#1f5fa8'"};
    io::Curve above{"3 sigma as reported", {}, {}, "lines linecolor rgb '#c03020'"};
    io::Curve below{"", {}, {}, "lines linecolor rgb '#c03020'"};
    for (const Point& point : points_) {
      error.x.push_back(point.t_s);
      error.y.push_back(point.error[which][axis]);
      const double bound = 3.0 * point.sigma[which][axis];
      if (!std::isfinite(bound) || bound <= 0.0) continue;
      above.x.push_back(point.t_s);
      above.y.push_back(bound);
      below.x.push_back(point.t_s);
      below.y.push_back(-bound);
    }
    io::Panel panel;
    panel.title = kAxes[axis];
    panel.x_label = axis == 2 ? "sim time (s)" : "";
    panel.y_label = unit;
    panel.curves = {io::thinned(error, kBins)};
    if (!above.x.empty())
      panel.curves.insert(panel.curves.end(), {io::thinned(above, kBins), io::thinned(below, kBins)});
    for (const score::OutageDrift& outage : score.scorer.outages()) {
      panel.bands.push_back({static_cast<double>(outage.begin_ns) * 1e-9, static_cast<double>(outage.end_ns) * 1e-9});
    }
    for (const ProfileInUse& swap : summary.profiles) {
      if (swap.apply_at_ns >= 0) panel.marks.push_back(static_cast<double>(swap.apply_at_ns) * 1e-9);
    }
    picture.panels.push_back(panel);
  }
  return picture;
}

io::Picture ErrorCurves::position(const LogScore& score, const LogSummary& summary) const {
  return errors(0, "Position error", "m", score, summary);
}

io::Picture ErrorCurves::velocity(const LogScore& score, const LogSummary& summary) const {
  return errors(1, "Velocity error", "m/s", score, summary);
}

io::Picture ErrorCurves::attitude(const LogScore& score, const LogSummary& summary) const {
  return errors(2, "Attitude error: rotation vector about north, east, down", "deg", score, summary);
}

io::Picture ErrorCurves::track() const {
  io::Curve truth{"truth", {}, {}, "lines linewidth 3 linecolor rgb '#9aa7b8'"};
  io::Curve app{"app", {}, {}, "lines linecolor rgb '#c03020'"};
  for (const Point& point : points_) {
    const Vector3 place = nav::ned_from(points_.front().truth, point.truth);
    truth.x.push_back(place.y());
    truth.y.push_back(place.x());
    app.x.push_back(place.y() + point.error[0].y());
    app.y.push_back(place.x() + point.error[0].x());
  }
  io::Panel panel;
  panel.title = "from the first solution";
  panel.x_label = "east (m)";
  panel.y_label = "north (m)";
  panel.equal_scales = true;
  panel.curves = {io::thinned_by_distance(truth, 0.05, 4000), io::thinned_by_distance(app, 0.05, 4000)};
  io::Picture picture;
  picture.title = "Track: truth and app";
  picture.panel_width_px = 900;
  picture.panel_height_px = 520;
  picture.panels = {panel};
  return picture;
}

io::Picture latency_picture(const score::Quantiles& latency_s) {
  constexpr double kBinsPerDecade = 20.0;
  std::map<int, double> wide;
  latency_s.for_each_bin([&](double latency, std::uint64_t count) {
    wide[static_cast<int>(std::floor(std::log10(latency * 1e3) * kBinsPerDecade))] += static_cast<double>(count);
  });
  io::Curve histogram{"", {}, {}, "impulses linewidth 8 linecolor rgb '#1f5fa8'"};
  for (const auto& [bin, count] : wide) {
    histogram.x.push_back(std::pow(10.0, (bin + 0.5) / kBinsPerDecade));
    histogram.y.push_back(count);
  }
  io::Panel panel;
  panel.title = "20 bins a decade";
  panel.x_label = "latency (ms)";
  panel.y_label = "solutions";
  panel.log_x = true;
  panel.curves = {histogram};
  io::Picture picture;
  picture.title = "Latency: IMU sample sent to solution received";
  picture.panel_width_px = 900;
  picture.panel_height_px = 300;
  picture.panels = {panel};
  return picture;
}

}  // namespace inslab::cli
