#include "services/inslab/report_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "score/score_text.hpp"

namespace inslab::cli {

namespace {

using scenario::Metric;

double seconds(std::int64_t ns) { return static_cast<double>(ns) * 1e-9; }

/// Four digits, without an exponent where a person would write none.
std::string shown(double value) {
  return std::abs(value) >= 1e4 && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string shown(const std::optional<double>& value) { return value ? shown(*value) : "-"; }

/// "between outages, after 60 s"
std::string phase_name(const score::PhaseKey& key) {
  std::string name = score::words_of(key);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

PageTable acceptance_table(const LogScore& score) {
  PageTable table{"Acceptance", {"result", "limit", "value", "why not"}, {}, {}, 2};
  bool all_passed = true;
  for (const score::Verdict& verdict : score.verdicts) {
    table.rows.push_back({verdict.passed ? "PASS" : "FAIL", score::words_of(verdict.limit), shown(verdict.value),
                          verdict.passed ? "" : verdict.why});
    all_passed = all_passed && verdict.passed;
  }
  if (!all_passed) return table;
  table.head.pop_back();
  for (auto& row : table.rows) row.pop_back();
  return table;
}

PageTable phases_table(const LogScore& score) {
  PageTable table{
      "Errors",
      {"phase", "solutions", "horizontal RMS, m", "CEP50, m", "CEP95, m", "vertical RMS, m", "velocity RMS, m/s",
       "tilt RMS, deg", "heading RMS, deg", "NEES p / v / a"},
      {},
      "NEES of position, velocity, attitude: squared error over the reported variance; 3 is expected of honest "
      "sigmas."};
  for (const auto& [key, errors] : score.scorer.phases()) {
    if (!score::is_shown(key, score.scorer, score.verdicts)) continue;
    std::vector<std::string> row{phase_name(key), std::to_string(errors.count())};
    for (const Metric metric : {Metric::HorizontalRms, Metric::Cep50, Metric::Cep95, Metric::VerticalRms,
                                Metric::VelocityRms, Metric::TiltRms, Metric::HeadingRms}) {
      row.push_back(shown(score::figure(score.scorer, metric, key)));
    }
    const auto nees = [&, &phase = key](Metric metric) -> std::string {
      const auto value = score::figure(score.scorer, metric, phase);
      return !value ? "-" : *value >= 1e3 ? shown(std::round(*value)) : fmt::format("{:.3g}", *value);
    };
    row.push_back(nees(Metric::PositionNees) + " / " + nees(Metric::VelocityNees) + " / " + nees(Metric::AttitudeNees));
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable outages_table(const LogScore& score, const Expectation& expectation) {
  PageTable table{"Outages",
                  {"from, s", "length, s", "largest horizontal, m", "largest vertical, m"},
                  {},
                  "Largest errors between the last fix before and the first fix after."};
  const bool has_expectation = !expectation.curve.empty();
  if (has_expectation) {
    table.head.insert(table.head.end(), {"horizontal to expect, m", "vertical to expect, m"});
    table.caption += " To expect: 1 sigma of " + expectation.of + " at the end; horizontal: north and east together.";
  }
  for (const score::OutageDrift& outage : score.scorer.outages()) {
    std::vector<std::string> row{fmt::format("{:.2f}", seconds(outage.begin_ns)),
                                 fmt::format("{:.2f}", seconds(outage.end_ns - outage.begin_ns)),
                                 shown(outage.horizontal_m), shown(outage.vertical_m)};
    const predict::PredictedError* expected = expectation.before(seconds(outage.end_ns));
    if (has_expectation) {
      row.push_back(expected == nullptr ? "-" : shown(expected->position_n_m.head<2>().norm()));
      row.push_back(expected == nullptr ? "-" : shown(expected->position_n_m.z()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable ratios_table(const ErrorCurves& curves, const Expectation& expectation, bool has_outages) {
  PageTable table{"Measured over expected", {"RMS", "position", "velocity", "attitude"}, {}};
  if (expectation.curve.empty()) return table;
  for (const bool in_outages : {false, true}) {
    const ErrorRatios ratios = curves.ratios(expectation, in_outages);
    if (ratios.solutions == 0) continue;
    const char* where = in_outages ? "in outages" : has_outages ? "between outages" : "all";
    table.rows.push_back({where, shown(ratios.position), shown(ratios.velocity), shown(ratios.attitude)});
  }
  table.caption = fmt::format(
      "Errors in units of 1 sigma of {}, told every profile: 1 is what sensors and fixes allow.{}", expectation.of,
      expectation.left_out.empty() ? "" : fmt::format(" Left out of it: {}.", fmt::join(expectation.left_out, ", ")));
  return table;
}

PageTable app_table(const LogScore& score) {
  const score::Scorer& scorer = score.scorer;
  const score::SolutionCounts& counts = scorer.counts();
  const auto of = [&](Metric metric) { return shown(score::figure(scorer, metric, {})); };
  PageTable table{"Navigation app", {"", ""}, {}};
  table.rows = {
      {"solutions received", std::to_string(counts.received)},
      {"scored", std::to_string(counts.scored)},
      {"rate, Hz", of(Metric::Rate)},
      {"first solution at, s", of(Metric::TimeToFirstSolution)},
      {"longest gap, s", of(Metric::LongestGap)},
      {"latency p50 / p99 / largest, ms",
       of(Metric::LatencyP50) + " / " + of(Metric::LatencyP99) + " / " + of(Metric::LatencyMax)},
      {"stale / future / not finite", fmt::format("{} / {} / {}", counts.stale, counts.future, counts.non_finite)},
      {"twice / out of order", fmt::format("{} / {}", counts.duplicates, counts.out_of_order)}};
  for (std::size_t i = 0; i < counts.modes.size(); ++i) {
    if (counts.modes[i] == 0) continue;
    table.rows.push_back({fmt::format("of mode {}", EnumNames<NavMode>::values[i]), std::to_string(counts.modes[i])});
  }
  if (!scorer.latency().why_none().empty()) {
    table.caption = "Latency is not judged: " + scorer.latency().why_none() + ".";
  } else if (scorer.latency().negative() > 0) {
    table.caption =
        fmt::format("{} latencies are negative: the hosts' clocks are unsynchronised.", scorer.latency().negative());
  }
  return table;
}

PageTable profiles_table(const LogSummary& summary) {
  PageTable table{"Profiles", {"profile", "sensor", "kind", "from, s"}, {}, {}, 3};
  for (const ProfileInUse& entry : summary.profiles) {
    const std::string& name = name_of(entry.profile);
    if (entry.apply_at_ns < 0 && name.empty()) continue;  // the scenario names none
    table.rows.push_back({name.empty() ? "(no name)" : name, sensor_name(target_of(entry.profile)),
                          std::string(enum_name(kind_of(entry.profile))),
                          entry.apply_at_ns < 0 ? "the start" : fmt::format("{:.3f}", seconds(entry.apply_at_ns))});
  }
  return table;
}

}  // namespace

std::vector<PageTable> report_tables(const LogScore& score, const LogSummary& summary, const ErrorCurves& curves,
                                     const Expectation& expectation) {
  std::vector<PageTable> tables;
  for (PageTable& table :
       std::vector<PageTable>{acceptance_table(score), phases_table(score), outages_table(score, expectation),
                              ratios_table(curves, expectation, !score.scorer.outages().empty()), app_table(score),
                              profiles_table(summary)}) {
    if (!table.rows.empty()) tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace inslab::cli
