#include "inslab/referee/montecarlo/summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace inslab::montecarlo {

namespace {

using Runs = std::vector<const RunResult*>;

std::vector<FigureSummary> figures_of(const Runs& runs) {
  std::map<std::tuple<double, scenario::Phase, std::uint32_t, scenario::Metric>, std::vector<const RunFigure*>> found;
  for (const RunResult* run : runs) {
    for (const RunFigure& f : run->figures) found[{f.after_s, f.phase, f.swap_interval, f.metric}].push_back(&f);
  }
  std::vector<FigureSummary> figures;
  for (const auto& [key, of_runs] : found) {
    std::vector<double> values;
    for (const RunFigure* figure : of_runs) values.push_back(figure->value);
    figures.push_back({*of_runs.front(), distribution_of(std::move(values))});
  }
  return figures;
}

std::vector<OutageSummary> outages_of(const Runs& runs) {
  const std::vector<RunOutage>& first = runs.front()->outages;
  for (const RunResult* run : runs) {
    if (run->outages.size() != first.size()) return {};
  }
  std::vector<OutageSummary> outages;
  for (std::size_t i = 0; i < first.size(); ++i) {
    std::vector<double> horizontal, vertical;
    for (const RunResult* run : runs) {
      horizontal.push_back(run->outages[i].horizontal_m);
      vertical.push_back(run->outages[i].vertical_m);
    }
    outages.push_back({first[i].begin_s, first[i].end_s, distribution_of(horizontal), distribution_of(vertical)});
  }
  return outages;
}

Believed believed(const std::vector<double>& errors, const std::vector<double>& sigmas) {
  return {rms_of(errors), rms_of(sigmas).value};
}

InstantSummary summary_of_instant(const std::vector<const Instant*>& runs) {
  std::vector<double> horizontal, vertical, velocity, tilt, heading, nees;
  std::vector<double> s_horizontal, s_vertical, s_velocity, s_tilt, s_heading;
  for (const Instant* i : runs) {
    horizontal.push_back(i->position_error_ned_m.head<2>().norm());
    s_horizontal.push_back(i->position_sigma_ned_m.head<2>().norm());
    vertical.push_back(i->position_error_ned_m.z());
    s_vertical.push_back(i->position_sigma_ned_m.z());
    velocity.push_back(i->velocity_error_ned_m_per_s.norm());
    s_velocity.push_back(i->velocity_sigma_ned_m_per_s.norm());
    tilt.push_back(i->phi_ned_deg.head<2>().norm());
    s_tilt.push_back(i->phi_sigma_ned_deg.head<2>().norm());
    heading.push_back(i->phi_ned_deg.z());
    s_heading.push_back(i->phi_sigma_ned_deg.z());
    nees.push_back(i->nees);
  }
  constexpr double kDegrees = 9.0;
  return {runs.front()->time_s,
          runs.size(),
          believed(horizontal, s_horizontal),
          believed(vertical, s_vertical),
          believed(velocity, s_velocity),
          believed(tilt, s_tilt),
          believed(heading, s_heading),
          quantile_of(horizontal, 0.50),
          quantile_of(horizontal, 0.95),
          mean_of(nees).value,
          chi_square_mean_band(kDegrees, runs.size())};
}

std::vector<InstantSummary> instants_of(const Runs& runs) {
  std::map<std::uint32_t, std::vector<const Instant*>> found;
  for (const RunResult* run : runs) {
    for (const Instant& instant : run->instants) found[instant.number].push_back(&instant);
  }
  std::vector<InstantSummary> instants;
  for (const auto& [number, of_runs] : found) instants.push_back(summary_of_instant(of_runs));
  return instants;
}

std::optional<Estimate> nees_of(const Runs& runs) {
  std::vector<double> means;
  for (const RunResult* run : runs) {
    if (run->instants.empty()) continue;
    double sum = 0.0;
    for (const Instant& instant : run->instants) sum += instant.nees;
    means.push_back(sum / static_cast<double>(run->instants.size()));
  }
  return means.empty() ? std::nullopt : std::optional<Estimate>(mean_of(means));
}

std::vector<LineSummary> acceptance_of(const Runs& runs) {
  std::vector<LineSummary> lines;
  for (std::size_t i = 0; i < runs.front()->acceptance.size(); ++i) {
    const RunVerdict& first = runs.front()->acceptance[i];
    LineSummary line{first.line, first.judged, "", 0, {}};
    for (const RunResult* run : runs) {
      const RunVerdict& verdict = run->acceptance.at(i);
      if (verdict.passed) ++line.passed;
      if (!verdict.passed && line.why.empty()) {
        line.why = first.judged ? "run " + std::to_string(run->run) + ": " + verdict.why : verdict.why;
      }
    }
    line.share = share_of(line.passed, runs.size());
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

Distribution distribution_of(std::vector<double> values) {
  Distribution d{{},
                 mean_of(values),
                 rms_of(values),
                 quantile_of(values, 0.50),
                 quantile_of(values, 0.95),
                 quantile_of(values, 0.99)};
  d.values = std::move(values);
  return d;
}

Summary summary_of(const std::string& name, const std::string& fingerprint, std::uint64_t first_seed,
                   std::uint32_t wanted, const std::vector<RunResult>& results) {
  Summary summary;
  summary.name = name;
  summary.fingerprint = fingerprint;
  summary.first_seed = first_seed;
  summary.wanted = wanted;
  Runs runs;
  std::uint32_t next = 0;
  for (const RunResult& result : results) {
    for (; next < result.run; ++next) summary.missing.push_back(next);
    ++next;
    if (result.succeeded()) {
      runs.push_back(&result);
    } else {
      summary.failed.push_back({result.run, result.seed, result.failure});
    }
  }
  for (; next < wanted; ++next) summary.missing.push_back(next);
  summary.succeeded = runs.size();
  if (runs.empty()) return summary;
  summary.figures = figures_of(runs);
  summary.outages = outages_of(runs);
  summary.instants = instants_of(runs);
  summary.nees = nees_of(runs);
  summary.nees_instants_out = static_cast<std::size_t>(
      std::count_if(summary.instants.begin(), summary.instants.end(),
                    [](const InstantSummary& instant) { return !instant.nees_band.contains(instant.nees); }));
  summary.acceptance = acceptance_of(runs);
  return summary;
}

}  // namespace inslab::montecarlo
