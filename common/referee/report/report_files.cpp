#include "inslab/referee/report/report_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "inslab/data/json/json_text.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/calibrate/report.hpp"
#include "inslab/referee/report/report_limits.hpp"
#include "inslab/referee/report/report_tables.hpp"
#include "inslab/referee/score/score_json.hpp"
#include "inslab/referee/score/score_words.hpp"

namespace inslab::report {

namespace {

using Json = nlohmann::ordered_json;

/// The same picture for a screen of 390 pixels.
tables::Picture narrowed(tables::Picture picture) {
  constexpr int kWidth_px = 380;
  picture.panel_height_px = std::min(picture.panel_height_px, 260);
  picture.panel_width_px = kWidth_px;
  picture.columns = 1;
  return picture;
}

/// The page says the picture's title.
void add_figure(ReportPage& page, tables::Picture picture, const std::string& caption, const std::string& id = {}) {
  const std::string title = std::exchange(picture.title, "");
  page.figures.push_back({title, caption, tables::drawn(picture, tables::PictureFormat::Svg),
                          tables::drawn(narrowed(picture), tables::PictureFormat::Svg), id});
}

void add_allan(ReportPage& page, const ReportData& data) {
  if (!data.why_no_imu_errors.empty()) page.notes.push_back("No Allan deviation: " + data.why_no_imu_errors);
  if (!data.imu_errors) return;
  const SensorAddress imu{SensorKind::Imu, data.summary.scenario.imu.front().number};
  const auto& profiles = data.summary.profiles;
  const bool was_swapped = std::any_of(profiles.begin(), profiles.end(), [&imu](const evidence::ProfileInUse& entry) {
    return entry.apply_at_ns >= 0 && catalog::target_of(entry.profile) == imu;
  });
  add_figure(
      page, calibrate::curve_picture(*data.imu_errors),
      fmt::format("IMU {} less its truth over the whole run{}; points, 99 % bands dotted, fitted model as a line.",
                  imu.number, was_swapped ? ", across its swaps" : ""));
}

std::string ratios_text(const ErrorRatios& ratios, const std::string& where) {
  if (ratios.solutions == 0) return "";
  return fmt::format("; {}: position {:.2f}, velocity {:.2f}, attitude {:.2f}", where, ratios.position, ratios.velocity,
                     ratios.attitude);
}

/// Empty when there is nothing to expect.
std::string expectation_text(const ReportData& data) {
  const Expectation& expectation = data.expectation;
  if (expectation.curve.empty()) return "";
  return fmt::format(
      "Measured over expected (1 sigma of {}, told every profile), RMS{}{}.{}", expectation.of,
      ratios_text(data.between_outages, data.score.scorer.outages().empty() ? "all" : "between outages"),
      ratios_text(data.in_outages, "in outages"),
      expectation.left_out.empty() ? "" : fmt::format(" Left out of it: {}.", fmt::join(expectation.left_out, ", ")));
}

Json ratios_json(const ErrorRatios& ratios) {
  if (ratios.solutions == 0) return nullptr;
  return {{"position", ratios.position}, {"velocity", ratios.velocity}, {"attitude", ratios.attitude}};
}

/// Enough to draw from: a row a second, of long runs fewer.
Json curve_json(const Expectation& expectation) {
  constexpr double kMostRows = 4000.0;
  const double span_s = expectation.curve.back().time_s - expectation.curve.front().time_s;
  const double every_s = std::max(1.0, span_s / kMostRows);
  Json rows = Json::array();
  double next_s = -std::numeric_limits<double>::infinity();
  for (const predict::PredictedError& error : expectation.curve) {
    if (error.time_s < next_s) continue;
    next_s = error.time_s + every_s;
    Json row{error.time_s};
    for (const Vector3& sigma : {error.position_n_m, error.velocity_n_m_per_s, error.attitude_n_rad}) {
      for (const double value : sigma) row.push_back(value);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json expectation_json(const ReportData& data) {
  const Expectation& expectation = data.expectation;
  if (expectation.curve.empty()) return {{"missing", expectation.missing}};
  Json json{{"of", expectation.of},
            {"left_out", expectation.left_out},
            {"measured_over_expected_between_outages", ratios_json(data.between_outages)},
            {"measured_over_expected_in_outages", ratios_json(data.in_outages)}};
  json["outages"] = Json::array();
  for (const score::OutageDrift& outage : data.score.scorer.outages()) {
    const predict::PredictedError* end = expectation.before(time::to_seconds(outage.end_ns));
    if (end == nullptr) continue;
    json["outages"].push_back({{"end_s", time::to_seconds(outage.end_ns)},
                               {"horizontal_sigma_m", end->position_n_m.head<2>().norm()},
                               {"vertical_sigma_m", end->position_n_m.z()}});
  }
  json["columns"] = {"time_s",
                     "position_north_m",
                     "position_east_m",
                     "position_down_m",
                     "velocity_north_m_per_s",
                     "velocity_east_m_per_s",
                     "velocity_down_m_per_s",
                     "phi_north_rad",
                     "phi_east_rad",
                     "phi_down_rad"};
  json["sigma"] = curve_json(expectation);
  return json;
}

Json worst_json(const score::LogScore& score) {
  if (!score.worst.found()) return nullptr;
  const score::Moment& moment = *score.worst.found();
  return {{"time_s", moment.time_s},
          {"horizontal_m", moment.horizontal_m},
          {"vertical_m", moment.vertical_m},
          {"horizontal_sigma_m", moment.horizontal_sigma_m},
          {"speed_m_per_s", moment.speed_m_per_s},
          {"turn_rate_deg_per_s", moment.turn_rate_deg_per_s},
          {"swap_interval", score.intervals.at(moment.time_s)},
          {"words", score::worst_words(score)}};
}

/// What no figure of a swap's evidence weighs, by its profile's name.
Json not_weighed_json(const std::vector<evidence::SwapEvidence>& swaps) {
  Json all = Json::array();
  for (const evidence::SwapEvidence& swap : swaps) {
    all.push_back(
        {{"profile", swap.profile_name}, {"kind", std::string(enum_name(swap.ack.kind))}, {"left_out", swap.left_out}});
  }
  return all;
}

Json intervals_json(const score::SwapIntervals& intervals) {
  Json names = Json::array();
  for (std::size_t i = 0; i <= intervals.count(); ++i) names.push_back(intervals.name(i));
  return names;
}

Json run_json(const evidence::LogSummary& summary) {
  const evidence::RunIdentity& run = summary.identity;
  return {{"run_id", run.run_id},      {"began", run.began_utc}, {"scenario", summary.scenario.name},
          {"file", run.scenario_file}, {"unit", run.unit},       {"seed", summary.scenario.seed},
          {"version", run.version}};
}

/// "run 2026-11-29 04:20:11 UTC, id 0a1b..., scenario demo (demo.json), seed 7, inslab 0.1.0, log demo.mcap"
std::string identity_words(const evidence::LogSummary& summary) {
  const evidence::RunIdentity& run = summary.identity;
  std::string words = run.began_utc.empty() ? "Simulated in one process" : "Run of " + run.began_utc;
  if (!run.run_id.empty()) words += ", id " + run.run_id;
  words += "; scenario " + summary.scenario.name;
  if (!run.scenario_file.empty()) words += " (" + run.scenario_file + ")";
  words += fmt::format(", seed {}", summary.scenario.seed);
  if (!run.unit.empty()) words += ", unit " + run.unit;
  return words +
         fmt::format("; inslab {}; log {}", run.version, std::filesystem::path(summary.path).filename().string());
}

}  // namespace

std::string write_report(const ReportData& data, const std::string& folder) {
  std::filesystem::create_directories(folder);
  const std::vector<std::string> paths = report_paths(data.summary.path, folder);
  for (const std::string& path : paths) files::check_output(path);  // before the first is written
  files::write_file(paths[0], report_text(data));
  files::write_file(paths[1], json::json_text(report_json(data)));
  files::write_file(paths[2], html(report_page(data)));
  return std::filesystem::path(paths[2]).replace_extension().string();
}

std::vector<std::string> report_paths(const std::string& log, const std::string& folder) {
  const std::string stem = (std::filesystem::path(folder) / std::filesystem::path(log).stem()).string();
  return {stem + ".txt", stem + ".json", stem + ".html"};
}

std::string report_text(const ReportData& data) {
  const std::string text = score::score_words(data.score);
  const std::string expected = expectation_text(data);
  return expected.empty() ? text : text + "\n" + expected + "\n";
}

Json report_json(const ReportData& data) {
  Json report = score::score_json(data.score.scorer, data.score.verdicts);
  report["run"] = run_json(data.summary);
  report["verdict"] = score::verdict_words(data.score);
  report["worst"] = worst_json(data.score);
  report["swap_intervals"] = intervals_json(data.score.intervals);
  report["swaps_not_weighed"] = not_weighed_json(data.swaps);
  report["expected"] = expectation_json(data);
  return report;
}

ReportPage report_page(const ReportData& data) {
  const evidence::LogSummary& summary = data.summary;
  const score::LogScore& score = data.score;
  const ErrorCurves& curves = data.curves;
  const Expectation& expectation = data.expectation;
  ReportPage page;
  page.title = "Inslab report: " + summary.scenario.name;
  page.description = summary.scenario.description;
  page.verdict = score::verdict_words(score);
  page.accepted = score.accepted();
  page.worst = score::worst_words(score);
  page.identity = identity_words(summary);
  page.tables = report_tables(data);
  if (curves.empty()) {
    page.notes.push_back("No solution was scored: there are no errors to draw.");
  } else {
    const std::string how =
        "Estimate less truth; 3 sigma as the app reports and to expect; outages shaded, swaps dashed.";
    const std::string sizes = "By logarithms, with 1 sigma and the limits of the acceptance; ";
    add_figure(page, curves.sizes(score, summary, expectation),
               sizes + "horizontal: north and east together; less than 1 mm is drawn as 1 mm.", page_id::kSizes);
    add_figure(page, curves.track(), "Horizontal track of the reference point, true and as the app has it.");
    add_figure(page, curves.position(score, summary, expectation), how);
    add_figure(page, curves.motion_sizes(score, summary, expectation),
               sizes + "tilt: about north and east together; less than 0.0001 is drawn as 0.0001.",
               page_id::kMotionSizes);
    add_figure(page, curves.velocity(score, summary, expectation), how);
    add_figure(page, curves.attitude(score, summary, expectation), how);
    const tables::Picture honesty = curves.honesty(score, summary);
    if (!honesty.panels.empty()) {
      add_figure(page, honesty, "Squared error over the reported variance, summed over the axes, of each solution.",
                 page_id::kHonesty);
    }
  }
  if (expectation.curve.empty()) page.notes.push_back("No errors to expect: " + expectation.missing + ".");
  if (score.scorer.latency().seconds().count() > 0 && score.scorer.latency().why_none().empty()) {
    add_figure(page, latency_picture(score), "20 bins a decade; both times by CLOCK_REALTIME of their hosts.",
               page_id::kLatency);
  }
  add_allan(page, data);
  return page;
}

}  // namespace inslab::report
