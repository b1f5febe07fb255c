#include "inslab/referee/montecarlo/summary_picture.hpp"

#include <algorithm>
#include <limits>

namespace inslab::montecarlo {

namespace {

constexpr const char* kMeasured = "lines linewidth 2 linecolor rgb '#1f5fa8'";
constexpr const char* kBound = "lines dashtype 3 linecolor rgb '#1f5fa8'";
constexpr const char* kBelieved = "lines linecolor rgb '#c03020'";

/// The drift in outages where there are some, else the errors of the whole run.
const FigureSummary* drift_of(const Summary& summary) {
  const FigureSummary* found = nullptr;
  for (const FigureSummary& figure : summary.figures) {
    if (figure.figure.metric == scenario::Metric::OutageDriftMax) return &figure;
    if (figure.figure.metric == scenario::Metric::HorizontalRms && found == nullptr) found = &figure;
  }
  return found;
}

tables::Panel distribution_panel(const FigureSummary& figure) {
  std::vector<double> sorted = figure.over_runs.values;
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  tables::Curve share{"", {}, {}, "steps linewidth 2 linecolor rgb '#1f5fa8'"};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    share.x.push_back(sorted[i]);
    share.y.push_back((static_cast<double>(i) + 1.0) / n);
  }
  tables::Panel panel;
  panel.title = std::string(enum_name(figure.figure.metric)) + " of the runs";
  panel.x_label = "m; dashed: 50 % and 95 %";
  panel.y_label = "share of runs";
  panel.curves = {share};
  panel.marks = {figure.over_runs.p50.value, figure.over_runs.p95.value};
  return panel;
}

tables::Panel over_time(const Summary& summary, const char* label, Believed InstantSummary::*which) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  tables::Curve rms{"RMS over the runs", {}, {}, kMeasured};
  tables::Curve low{"95 % confidence", {}, {}, kBound};
  tables::Curve high{"", {}, {}, kBound};
  tables::Curve sigma{"sigma as reported", {}, {}, kBelieved};
  for (const InstantSummary& instant : summary.instants) {
    const Believed& b = instant.*which;
    for (tables::Curve* curve : {&rms, &low, &high, &sigma}) curve->x.push_back(instant.time_s);
    rms.y.push_back(b.rms.value);
    low.y.push_back(b.rms.low.value_or(kNaN));
    high.y.push_back(b.rms.high.value_or(kNaN));
    sigma.y.push_back(b.sigma);
  }
  tables::Panel panel;
  panel.y_label = label;
  panel.curves = {rms, sigma};
  if (summary.succeeded > 1) panel.curves.insert(panel.curves.end(), {low, high});
  for (const OutageSummary& outage : summary.outages) panel.bands.push_back({outage.begin_s, outage.end_s});
  return panel;
}

tables::Panel nees_over_time(const Summary& summary) {
  tables::Curve nees{"mean over the runs", {}, {}, kMeasured};
  tables::Curve low{"95 % band of an honest filter", {}, {}, kBelieved};
  tables::Curve high{"", {}, {}, kBelieved};
  for (const InstantSummary& instant : summary.instants) {
    for (tables::Curve* curve : {&nees, &low, &high}) curve->x.push_back(instant.time_s);
    nees.y.push_back(instant.nees);
    low.y.push_back(instant.nees_band.low);
    high.y.push_back(instant.nees_band.high);
  }
  tables::Panel panel;
  panel.x_label = "sim time (s)";
  panel.y_label = "NEES, 9 degrees";
  panel.log_y = true;
  panel.curves = {nees, low, high};
  return panel;
}

}  // namespace

tables::Picture summary_picture(const Summary& summary) {
  tables::Picture picture;
  picture.title = summary.name + ": " + std::to_string(summary.succeeded) + " runs";
  picture.panel_width_px = 900;
  picture.panel_height_px = 240;
  if (const FigureSummary* drift = drift_of(summary)) picture.panels.push_back(distribution_panel(*drift));
  if (summary.instants.empty()) return picture;
  picture.panels.push_back(over_time(summary, "horizontal (m)", &InstantSummary::horizontal_m));
  picture.panels.push_back(over_time(summary, "vertical (m)", &InstantSummary::vertical_m));
  picture.panels.push_back(over_time(summary, "velocity (m/s)", &InstantSummary::velocity_m_per_s));
  picture.panels.push_back(over_time(summary, "tilt (deg)", &InstantSummary::tilt_deg));
  picture.panels.push_back(over_time(summary, "heading (deg)", &InstantSummary::heading_deg));
  picture.panels.push_back(nees_over_time(summary));
  return picture;
}

}  // namespace inslab::montecarlo
