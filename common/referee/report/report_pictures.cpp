#include "inslab/referee/report/report_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/report/report_limits.hpp"

namespace inslab::report {

namespace {

constexpr std::size_t kMostPoints = 40000;
constexpr std::size_t kBins = 400;  // of a curve over time
constexpr const char* kErrorStyle = "lines linecolor rgb '#1f5fa8'";
constexpr const char* kReportedStyle = "lines linecolor rgb '#c03020'";
constexpr const char* kExpectedStyle = "lines dashtype 2 linewidth 1.5 linecolor rgb '#208040'";
constexpr const char* kAxes[] = {"north", "east", "down"};

/// Position m, velocity m/s, phi deg.
Vector3 expected_of(const predict::PredictedError& error, std::size_t which) {
  if (which == 0) return error.position_n_m;
  return which == 1 ? error.velocity_n_m_per_s : Vector3(error.attitude_n_rad * units::kDegPerRad);
}

double extent_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return values.empty() ? 0.0 : *high - *low;
}

/// Outages shaded, swaps marked.
void mark(tables::Panel& panel, const score::LogScore& score, const evidence::LogSummary& summary) {
  for (const score::OutageDrift& outage : score.scorer.outages()) {
    panel.bands.push_back({time::to_seconds(outage.begin_ns), time::to_seconds(outage.end_ns)});
  }
  for (const evidence::ProfileInUse& swap : summary.profiles) {
    if (swap.apply_at_ns >= 0) panel.marks.push_back(time::to_seconds(swap.apply_at_ns));
  }
}

/// A size on a logarithmic axis, without the depths at which an error passes through 0.
void add_size(tables::Curve& curve, double t_s, double size, double smallest) {
  if (!std::isfinite(size)) return;
  curve.x.push_back(t_s);
  curve.y.push_back(std::max(size, smallest));
}

double horizontal(const Vector3& v) { return v.head<2>().norm(); }
double vertical(const Vector3& v) { return std::abs(v.z()); }
double length(const Vector3& v) { return v.norm(); }

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
  void draw(tables::Panel& panel) const {
    if (above_.x.empty()) return;
    panel.curves.push_back(tables::thinned(above_, kBins));
    panel.curves.push_back(tables::thinned(below_, kBins));
  }

 private:
  tables::Curve above_, below_;
};

}  // namespace

void ErrorCurves::add(const score::ScoredSolution& scored) {
  if (added_++ % keep_every_ != 0) return;
  const NavSolution& solution = scored.solution;
  points_.push_back(
      {time::to_seconds(scored.sim_time_ns),
       scored.in_outage,
       {scored.error.position_ned_m, scored.error.velocity_ned_m_per_s, scored.error.phi_rad * units::kDegPerRad},
       {solution.position_sigma_ned_m, solution.velocity_sigma_ned_m_per_s,
        solution.attitude_sigma_rad * units::kDegPerRad},
       scored.truth.position});
  if (points_.size() < kMostPoints) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  keep_every_ *= 2;
}

tables::Picture ErrorCurves::errors(std::size_t which, const std::string& title, const std::string& unit,
                                    const score::LogScore& score, const evidence::LogSummary& summary,
                                    const Expectation& expectation) const {
  tables::Picture picture;
  picture.title = title;
  picture.panel_width_px = 900;
  picture.panel_height_px = 220;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    tables::Curve error{"error", {}, {}, kErrorStyle};
    Bounds reported("3 sigma as reported", kReportedStyle), expected("3 sigma to expect", kExpectedStyle);
    for (const Point& point : points_) {
      error.x.push_back(point.t_s);
      error.y.push_back(point.error[which][axis]);
      reported.add(point.t_s, point.sigma[which][axis]);
    }
    for (const predict::PredictedError& sigma : expectation.curve) {
      expected.add(sigma.time_s, expected_of(sigma, which)[axis]);
    }
    tables::Panel panel;
    panel.x_label = axis == 2 ? "sim time (s)" : "";
    panel.y_label = std::string(kAxes[axis]) + " (" + unit + ")";
    panel.tight_x = true;
    panel.has_key = axis == 2;
    reported.draw(panel);
    expected.draw(panel);
    panel.curves.push_back(tables::thinned(error, kBins));
    mark(panel, score, summary);
    picture.panels.push_back(panel);
  }
  return picture;
}

tables::Picture ErrorCurves::position(const score::LogScore& score, const evidence::LogSummary& summary,
                                      const Expectation& expectation) const {
  return errors(0, "Position error", "m", score, summary, expectation);
}

/// One panel of sizes: what it measures, and which metrics of the acceptance are about it.
struct ErrorCurves::Size {
  const char* label;
  std::size_t which;  ///< position, velocity, attitude
  double (*of)(const Vector3&);
  double smallest;  ///< smaller ones are drawn as this
  std::vector<scenario::Metric> metrics;
};

tables::Picture ErrorCurves::size_panels(const std::string& title, const std::vector<Size>& sizes,
                                         const score::LogScore& score, const evidence::LogSummary& summary,
                                         const Expectation& expectation) const {
  tables::Picture picture;
  picture.title = title;
  picture.panel_width_px = 900;
  picture.panel_height_px = 280;
  for (const Size& size : sizes) {
    tables::Curve error{"error", {}, {}, kErrorStyle}, reported{"1 sigma as reported", {}, {}, kReportedStyle},
        expected{"1 sigma to expect", {}, {}, kExpectedStyle};
    for (const Point& point : points_) {
      add_size(error, point.t_s, size.of(point.error[size.which]), size.smallest);
      add_size(reported, point.t_s, size.of(point.sigma[size.which]), size.smallest);
    }
    for (const predict::PredictedError& sigma : expectation.curve) {
      add_size(expected, sigma.time_s, size.of(expected_of(sigma, size.which)), size.smallest);
    }
    const bool is_last = &size == &sizes.back();
    tables::Panel panel;
    panel.x_label = is_last ? "sim time (s)" : "";
    panel.y_label = size.label;
    panel.tight_x = panel.log_y = true;
    const std::vector<tables::Curve> limits = limit_curves(size.metrics, score, end_s());
    panel.has_key = is_last || !limits.empty();
    for (const tables::Curve& curve : {error, reported, expected}) {
      if (!curve.x.empty()) panel.curves.push_back(tables::thinned_by_logarithm(curve, kBins));
    }
    panel.curves.insert(panel.curves.end(), limits.begin(), limits.end());
    mark(panel, score, summary);
    picture.panels.push_back(panel);
  }
  return picture;
}

tables::Picture ErrorCurves::sizes(const score::LogScore& score, const evidence::LogSummary& summary,
                                   const Expectation& expectation) const {
  using scenario::Metric;
  constexpr double kSmallest_m = 1e-3;
  return size_panels("Size of the position error",
                     {{"horizontal (m)",
                       0,
                       horizontal,
                       kSmallest_m,
                       {Metric::HorizontalRms, Metric::HorizontalMax, Metric::Cep50, Metric::Cep95,
                        Metric::OutageDriftRms, Metric::OutageDriftMax}},
                      {"vertical (m)",
                       0,
                       vertical,
                       kSmallest_m,
                       {Metric::VerticalRms, Metric::VerticalMax, Metric::Vertical50, Metric::Vertical95,
                        Metric::OutageVerticalDriftRms, Metric::OutageVerticalDriftMax}}},
                     score, summary, expectation);
}

tables::Picture ErrorCurves::motion_sizes(const score::LogScore& score, const evidence::LogSummary& summary,
                                          const Expectation& expectation) const {
  using scenario::Metric;
  constexpr double kSmallest = 1e-4;  // m/s, deg
  return size_panels("Size of the velocity and attitude errors",
                     {{"velocity (m/s)", 1, length, kSmallest, {Metric::VelocityRms}},
                      {"tilt (deg)", 2, horizontal, kSmallest, {Metric::TiltRms}},
                      {"heading (deg)", 2, vertical, kSmallest, {Metric::HeadingRms}}},
                     score, summary, expectation);
}

tables::Picture ErrorCurves::honesty(const score::LogScore& score, const evidence::LogSummary& summary) const {
  using scenario::Metric;
  constexpr double kSmallest = 1e-2;
  constexpr const char* kQuantities[] = {"position", "velocity", "attitude"};
  tables::Picture picture;
  picture.title = "Honesty of the reported sigmas";
  picture.panel_width_px = 900;
  picture.panel_height_px = 280;
  for (std::size_t which = 0; which < 3; ++which) {
    tables::Curve nees{"squared error over variance", {}, {}, kErrorStyle};
    tables::Curve honest{"3, of honest sigmas", {0.0, end_s()}, {3.0, 3.0}, kExpectedStyle};
    for (const Point& point : points_) {
      const Vector3& sigma = point.sigma[which];
      if (!sigma.allFinite() || !(sigma.minCoeff() > 0.0)) continue;
      add_size(nees, point.t_s, point.error[which].cwiseQuotient(sigma).squaredNorm(), kSmallest);
    }
    if (nees.x.empty()) continue;
    tables::Panel panel;
    panel.x_label = "sim time (s)";
    panel.y_label = std::string("NEES of ") + kQuantities[which];
    panel.tight_x = panel.log_y = true;
    panel.curves = {tables::thinned_by_logarithm(nees, kBins), honest};
    const auto metric = static_cast<Metric>(static_cast<std::uint32_t>(Metric::PositionNees) + which);
    for (const tables::Curve& limit : limit_curves({metric}, score, end_s())) panel.curves.push_back(limit);
    mark(panel, score, summary);
    picture.panels.push_back(panel);
  }
  return picture;
}

tables::Picture ErrorCurves::velocity(const score::LogScore& score, const evidence::LogSummary& summary,
                                      const Expectation& expectation) const {
  return errors(1, "Velocity error", "m/s", score, summary, expectation);
}

tables::Picture ErrorCurves::attitude(const score::LogScore& score, const evidence::LogSummary& summary,
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

tables::Picture ErrorCurves::track() const {
  tables::Curve truth{"truth", {}, {}, "lines linewidth 3 linecolor rgb '#9aa7b8'"};
  tables::Curve app{"app", {}, {}, "lines linecolor rgb '#c03020'"};
  for (const Point& point : points_) {
    const Vector3 place = nav::ned_from(points_.front().truth, point.truth);
    truth.x.push_back(place.y());
    truth.y.push_back(place.x());
    app.x.push_back(place.y() + point.error[0].y());
    app.y.push_back(place.x() + point.error[0].x());
  }
  tables::Panel panel;
  panel.x_label = "east of the first solution (m)";
  panel.y_label = "north (m)";
  panel.equal_scales = true;
  const double extent_m = std::max(extent_of(truth.x), extent_of(truth.y));
  if (extent_m > 0.0) panel.tic_step = tables::tic_step_over(extent_m);
  panel.curves = {tables::thinned_by_distance(truth, 0.05, 4000), tables::thinned_by_distance(app, 0.05, 4000)};
  tables::Picture picture;
  picture.title = "Track: truth and app";
  picture.panel_width_px = 900;
  picture.panel_height_px = 520;
  picture.panels = {panel};
  return picture;
}

tables::Picture latency_picture(const score::LogScore& score) {
  constexpr double kBinsPerDecade = 20.0;
  std::map<int, double> wide;
  score.scorer.latency().seconds().for_each_bin([&](double latency, std::uint64_t count) {
    wide[static_cast<int>(std::floor(std::log10(latency * 1e3) * kBinsPerDecade))] += static_cast<double>(count);
  });
  tables::Curve histogram{"", {}, {}, "impulses linewidth 8 linecolor rgb '#1f5fa8'"};
  for (const auto& [bin, count] : wide) {
    histogram.x.push_back(std::pow(10.0, (bin + 0.5) / kBinsPerDecade));
    histogram.y.push_back(count);
  }
  tables::Panel panel;
  panel.x_label = "latency (ms)";
  panel.y_label = "solutions";
  panel.log_x = true;
  panel.curves = {histogram};
  const double height = histogram.y.empty() ? 1.0 : *std::max_element(histogram.y.begin(), histogram.y.end());
  for (const tables::Curve& limit : latency_limit_curves(score, height)) panel.curves.push_back(limit);
  tables::Picture picture;
  picture.title = "Latency: IMU sample sent to solution received";
  picture.panel_width_px = 900;
  picture.panel_height_px = 300;
  picture.panels = {panel};
  return picture;
}

}  // namespace inslab::report
