#include "services/inslab/report_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace inslab::cli {

namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr std::size_t kMostPoints = 40000;
constexpr std::size_t kBins = 400;  // of a curve over time
constexpr const char* kErrorStyle = "lines linecolor rgb '#1f5fa8'";
constexpr const char* kReportedStyle = "lines linecolor rgb '#c03020'";
constexpr const char* kExpectedStyle = "lines dashtype 2 linewidth 1.5 linecolor rgb '#208040'";
constexpr const char* kAxes[] = {"north", "east", "down"};

/// Position m, velocity m/s, phi deg.
Vector3 expected_of(const predict::PredictedError& error, std::size_t which) {
  if (which == 0) return error.position_n_m;
  return which == 1 ? error.velocity_n_m_per_s : Vector3(error.attitude_n_rad * kDegPerRad);
}

double extent_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0.0 : *high - *low;
}

/// Outages shaded, swaps marked.
void mark(io::Panel& panel, const LogScore& score, const LogSummary& summary) {
  for (const score::OutageDrift& outage : score.scorer.outages()) {
    panel.bands.push_back({static_cast<double>(outage.begin_ns) * 1e-9, static_cast<double>(outage.end_ns) * 1e-9});
  }
  for (const ProfileInUse& swap : summary.profiles) {
    if (swap.apply_at_ns >= 0) panel.marks.push_back(static_cast<double>(swap.apply_at_ns) * 1e-9);
  }
}

constexpr double kSmallestSize_m = 1e-3;

/// A size on a logarithmic axis, without the depths at which an error passes through 0.
void add_size(io::Curve& curve, double t_s, double size_m) {
  if (!std::isfinite(size_m)) return;
  curve.x.push_back(t_s);
  curve.y.push_back(std::max(size_m, kSmallestSize_m));
}

/// Plus and minus three sigmas; `y` gives one and whether there is one.
class Bounds {
 public:
  Bounds(const std::string& title, const std::string& style)
      : above_{title, {}, {}, style}, below_{"", {}, {}, style} {}
  void add(double t_s, double sigma) {
    if (!std::isfinite(sigma) || sigma <= 0.0) return;
    above_.x.push_back(t_s);
    below_.x.push_back(t_s);
    above_.y.push_back(3.0 * sigma);
    below_.y.push_back(-3.0 * sigma);
  }
  void draw(io::Panel& panel) const {
    if (above_.x.empty()) return;
    panel.curves.push_back(io::thinned(above_, kBins));
    panel.curves.push_back(io::thinned(below_, kBins));
  }

 private:
  io::Curve above_, below_;
};

}  // namespace

void ErrorCurves::add(const score::ScoredSolution& scored) {
  if (added_++ % keep_every_ != 0) return;
  const NavSolution& solution = scored.solution;
  points_.push_back(
      {static_cast<double>(scored.sim_time_ns) * 1e-9,
       scored.in_outage,
       {scored.error.position_ned_m, scored.error.velocity_ned_m_per_s, scored.error.phi_rad * kDegPerRad},
       {solution.position_sigma_ned_m, solution.velocity_sigma_ned_m_per_s, solution.attitude_sigma_rad * kDegPerRad},
       scored.truth.position});
  if (points_.size() < kMostPoints) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  keep_every_ *= 2;
}

io::Picture ErrorCurves::errors(std::size_t which, const std::string& title, const std::string& unit,
                                const LogScore& score, const LogSummary& summary,
                                const Expectation& expectation) const {
  io::Picture picture;
  picture.title = title;
  picture.panel_width_px = 900;
  picture.panel_height_px = 220;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    io::Curve error{"error", {}, {}, kErrorStyle};
    Bounds reported("3 sigma as reported", kReportedStyle), expected("3 sigma to expect", kExpectedStyle);
    for (const Point& point : points_) {
      error.x.push_back(point.t_s);
      error.y.push_back(point.error[which][axis]);
      reported.add(point.t_s, point.sigma[which][axis]);
    }
    for (const predict::PredictedError& sigma : expectation.curve) {
      expected.add(sigma.time_s, expected_of(sigma, which)[axis]);
    }
    io::Panel panel;
    panel.x_label = axis == 2 ? "sim time (s)" : "";
    panel.y_label = std::string(kAxes[axis]) + " (" + unit + ")";
    panel.tight_x = true;
    panel.has_key = axis == 2;
    reported.draw(panel);
    expected.draw(panel);
    panel.curves.push_back(io::thinned(error, kBins));
    mark(panel, score, summary);
    picture.panels.push_back(panel);
  }
  return picture;
}

io::Picture ErrorCurves::position(const LogScore& score, const LogSummary& summary,
                                  const Expectation& expectation) const {
  return errors(0, "Position error", "m", score, summary, expectation);
}

io::Picture ErrorCurves::sizes(const LogScore& score, const LogSummary& summary, const Expectation& expectation) const {
  io::Picture picture;
  picture.title = "Size of the position error";
  picture.panel_width_px = 900;
  picture.panel_height_px = 280;
  for (const bool is_horizontal : {true, false}) {
    const auto size = [is_horizontal](const Vector3& v) {
      return is_horizontal ? v.head<2>().norm() : std::abs(v.z());
    };
    io::Curve error{"error", {}, {}, kErrorStyle}, reported{"1 sigma as reported", {}, {}, kReportedStyle},
        expected{"1 sigma to expect", {}, {}, kExpectedStyle};
    for (const Point& point : points_) {
      add_size(error, point.t_s, size(point.error[0]));
      add_size(reported, point.t_s, size(point.sigma[0]));
    }
    for (const predict::PredictedError& sigma : expectation.curve)
      add_size(expected, sigma.time_s, size(sigma.position_n_m));
    io::Panel panel;
    panel.x_label = is_horizontal ? "" : "sim time (s)";
    panel.y_label = is_horizontal ? "horizontal (m)" : "vertical (m)";
    panel.tight_x = panel.log_y = true;
    panel.has_key = !is_horizontal;
    for (const io::Curve& curve : {error, reported, expected}) {
      if (!curve.x.empty()) panel.curves.push_back(io::thinned_by_logarithm(curve, kBins));
    }
    mark(panel, score, summary);
    picture.panels.push_back(panel);
  }
  return picture;
}

io::Picture ErrorCurves::velocity(const LogScore& score, const LogSummary& summary,
                                  const Expectation& expectation) const {
  return errors(1, "Velocity error", "m/s", score, summary, expectation);
}

io::Picture ErrorCurves::attitude(const LogScore& score, const LogSummary& summary,
                                  const Expectation& expectation) const {
  return errors(2, "Attitude error: rotation vector about north, east, down", "deg", score, summary, expectation);
}

ErrorRatios ErrorCurves::ratios(const Expectation& expectation, bool in_outages) const {
  double squares[3] = {}, counts[3] = {};
  std::size_t solutions = 0;
  for (const Point& point : points_) {
    const predict::PredictedError* expected = expectation.at(point.t_s);
    if (point.in_outage != in_outages || expected == nullptr) continue;
    ++solutions;
    for (std::size_t which = 0; which < 3; ++which) {
      const Vector3 sigma = expected_of(*expected, which);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (!(sigma[axis] > 0.0)) continue;
        const double ratio = point.error[which][axis] / sigma[axis];
        squares[which] += ratio * ratio;
        counts[which] += 1.0;
      }
    }
  }
  const auto rms = [&](std::size_t which) {
    return counts[which] > 0.0 ? std::sqrt(squares[which] / counts[which]) : 0.0;
  };
  return {rms(0), rms(1), rms(2), solutions};
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
  panel.x_label = "east of the first solution (m)";
  panel.y_label = "north (m)";
  panel.equal_scales = true;
  const double extent_m = std::max(extent_of(truth.x), extent_of(truth.y));
  if (extent_m > 0.0) panel.tic_step = io::tic_step_over(extent_m);
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
