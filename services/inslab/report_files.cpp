#include "services/inslab/report_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>

#include "io/error.hpp"
#include "score/score_text.hpp"
#include "services/inslab/allan/analysis.hpp"
#include "services/inslab/allan/report.hpp"
#include "services/inslab/report_pictures.hpp"

namespace inslab::cli {

namespace {

void add_figure(ReportPage& page, const io::Picture& picture, const std::string& caption) {
  page.figures.push_back({picture.title, caption, io::drawn(picture, io::PictureFormat::Svg)});
}

void add_allan(ReportPage& page, const io::McapReader& log, const LogSummary& summary) {
  if (summary.scenario.imu.empty()) return;
  AnalysisOptions options;
  options.recording.sensor_number = summary.scenario.imu.front().number;
  options.recording.minus_truth = options.recording.over_gaps = true;
  ImuAnalysis analysis;
  try {
    analysis = analyse_imu(log.path(), options);
  } catch (const io::ReadError& error) {
    page.notes.push_back(std::string("No Allan deviation: ") + error.what());
    return;
  }
  add_figure(page, curve_picture(analysis),
             fmt::format("IMU {} less its truth; points, 99 % bands dotted, fitted model as a line.",
                         summary.scenario.imu.front().number));
}

std::string verdict_text(const LogScore& score) {
  if (score.verdicts.empty()) return "";
  const auto passed = std::count_if(score.verdicts.begin(), score.verdicts.end(),
                                    [](const score::Verdict& verdict) { return verdict.passed; });
  return fmt::format("{}: {} of {} acceptance lines passed", score.accepted() ? "PASS" : "FAIL", passed,
                     score.verdicts.size());
}

}  // namespace

void write_text_file(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw io::WriteError(path, "writing the file", errno);
}

ReportPage report_page(const io::McapReader& log, const LogSummary& summary) {
  ErrorCurves curves;
  const LogScore score = score_log(log, summary, [&](const score::ScoredSolution& scored) { curves.add(scored); });
  ReportPage page{"Inslab report: " + summary.scenario.name,
                  summary.scenario.description,
                  verdict_text(score),
                  score.accepted(),
                  score::score_text(score.scorer, score.verdicts),
                  {},
                  {}};
  if (curves.empty()) {
    page.notes.push_back("No solution was scored: there are no errors to draw.");
  } else {
    const std::string how = "Estimate less truth; 3 sigma as the app reports; outages shaded, swaps dashed.";
    add_figure(page, curves.track(), "Horizontal track of the reference point, true and as the app has it.");
    add_figure(page, curves.position(score, summary), how);
    add_figure(page, curves.velocity(score, summary), how);
    add_figure(page, curves.attitude(score, summary), how);
  }
  if (score.scorer.latency().seconds().count() > 0 && score.scorer.latency().why_none().empty()) {
    add_figure(page, latency_picture(score.scorer.latency().seconds()), "Both times by CLOCK_REALTIME of their hosts.");
  }
  add_allan(page, log, summary);
  return page;
}

}  // namespace inslab::cli
