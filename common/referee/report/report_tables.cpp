#include "inslab/referee/report/report_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/report/report_limits.hpp"
#include "inslab/referee/score/score_text.hpp"

namespace inslab::report {

namespace {

using scenario::Metric;

/// Four digits, without an exponent where a person would write none.
std::string shown(double value) {
  return std::abs(value) >= 1e4 && std::abs(value) < 1e9 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string shown(const std::optional<double>& value) { return value ? shown(*value) : "-"; }

/// "between outages, after 60 s"; "from swap 2 on (imu_error 'adis16488' for imu0 at 20.000 s), after 25 s"
std::string phase_name(const score::PhaseKey& key, const score::SwapIntervals& intervals) {
  std::string name = score::words_of(key);
  std::replace(name.begin(), name.end(), '_', ' ');
  if (key.phase != scenario::Phase::SwapInterval) return name;
  const std::string number = "swap interval " + std::to_string(key.swap_interval);
  const std::string words = key.swap_interval == 0 ? intervals.name(0)
                                                   : fmt::format("from swap {} on ({})", key.swap_interval,
                                                                 intervals.name(key.swap_interval));
  return words + name.substr(std::min(number.size(), name.size()));
}

/// "horizontal_rms_m, before the first swap, after 5 s, at most 0.1"
std::string limit_words(const scenario::AcceptanceLimit& limit, const score::SwapIntervals& intervals) {
  if (limit.phase != scenario::Phase::SwapInterval) return score::words_of(limit);
  scenario::AcceptanceLimit of_the_run = limit;
  of_the_run.phase = scenario::Phase::All;
  of_the_run.after_s = 0.0;
  const std::string name(enum_name(limit.metric));
  return name + ", " + phase_name({limit.phase, limit.swap_interval, limit.after_s}, intervals) +
         score::words_of(of_the_run).substr(name.size());
}

/// As the line judges that asks for it; a figure that none asks for is odd where it is far from what it should be.
Tone tone_of(const score::LogScore& score, Metric metric, const score::PhaseKey& key, double least, double most) {
  const auto value = score::figure(score.scorer, metric, key);
  for (const score::Verdict& verdict : score.verdicts) {
    const scenario::AcceptanceLimit& limit = verdict.limit;
    const bool is_about_it = limit.metric == metric && limit.phase == key.phase &&
                             limit.swap_interval == key.swap_interval && limit.after_s == key.after_s;
    if (is_about_it) return verdict.passed ? Tone::Good : Tone::Bad;
  }
  return value && (*value < least || *value > most) ? Tone::Odd : Tone::Plain;
}

PageTable acceptance_table(const score::LogScore& score, const score::SwapIntervals& intervals) {
  PageTable table{"Acceptance", {"result", "limit", "value", "why not"}, {}, {}, 2, "acceptance"};
  bool all_passed = true;
  for (const score::Verdict& verdict : score.verdicts) {
    table.rows.push_back({verdict.passed ? "PASS" : "FAIL",
                          Cell(limit_words(verdict.limit, intervals), Tone::Plain, page_id_of(verdict.limit.metric)),
                          shown(verdict.value), verdict.passed ? "" : verdict.why});
    all_passed = all_passed && verdict.passed;
  }
  if (!all_passed) return table;
  table.head.pop_back();
  for (auto& row : table.rows) row.pop_back();
  return table;
}

PageTable phases_table(const score::LogScore& score, const score::SwapIntervals& intervals) {
  constexpr double kTooCautious = 1.0, kTooSure = 9.0;
  PageTable table{
      "Errors",
      {"phase", "solutions", "horizontal RMS, m", "CEP50, m", "CEP95, m", "vertical RMS, m", "velocity RMS, m/s",
       "tilt RMS, deg", "heading RMS, deg", "NEES of position", "velocity", "attitude"},
      {},
      "NEES: squared error over the reported variance; 3 is expected of honest sigmas. Figures that an acceptance line "
      "judges have the colour of its verdict; a NEES that none judges stands out below 1 and above 9."};
  for (const auto& [key, errors] : score.scorer.phases()) {
    if (!score::is_shown(key, score.scorer, score.verdicts)) continue;
    std::vector<Cell> row{phase_name(key, intervals), std::to_string(errors.count())};
    for (const Metric metric : {Metric::HorizontalRms, Metric::Cep50, Metric::Cep95, Metric::VerticalRms,
                                Metric::VelocityRms, Metric::TiltRms, Metric::HeadingRms}) {
      const double inf = std::numeric_limits<double>::infinity();
      row.emplace_back(shown(score::figure(score.scorer, metric, key)), tone_of(score, metric, key, -inf, inf));
    }
    for (const Metric metric : {Metric::PositionNees, Metric::VelocityNees, Metric::AttitudeNees}) {
      const auto value = score::figure(score.scorer, metric, key);
      row.emplace_back(!value          ? "-"
                       : *value >= 1e3 ? shown(std::round(*value))
                                       : fmt::format("{:.3g}", *value),
                       tone_of(score, metric, key, kTooCautious, kTooSure));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable outages_table(const score::LogScore& score, const Expectation& expectation) {
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
    std::vector<Cell> row{fmt::format("{:.2f}", time::to_seconds(outage.begin_ns)),
                          fmt::format("{:.2f}", time::to_seconds(outage.end_ns - outage.begin_ns)),
                          shown(outage.horizontal_m), shown(outage.vertical_m)};
    const predict::PredictedError* expected = expectation.before(time::to_seconds(outage.end_ns));
    if (has_expectation) {
      row.push_back(expected == nullptr ? "-" : shown(expected->position_n_m.head<2>().norm()));
      row.push_back(expected == nullptr ? "-" : shown(expected->position_n_m.z()));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable ratios_table(const ReportData& data, bool has_outages) {
  const Expectation& expectation = data.expectation;
  PageTable table{"Measured over expected", {"RMS", "position", "velocity", "attitude"}, {}};
  if (expectation.curve.empty()) return table;
  for (const bool in_outages : {false, true}) {
    const ErrorRatios& ratios = in_outages ? data.in_outages : data.between_outages;
    if (ratios.solutions == 0) continue;
    const char* where = in_outages ? "in outages" : has_outages ? "between outages" : "all";
    const auto cell = [](double ratio) {
      constexpr double kFar = 3.0;
      return Cell(shown(ratio), ratio > kFar || ratio < 1.0 / kFar ? Tone::Odd : Tone::Plain);
    };
    table.rows.push_back({where, cell(ratios.position), cell(ratios.velocity), cell(ratios.attitude)});
  }
  table.caption = fmt::format(
      "Errors in units of 1 sigma of {}, told every profile: 1 is what sensors and fixes allow; below a third "
      "and above 3 stand out.{}",
      expectation.of,
      expectation.left_out.empty() ? "" : fmt::format(" Left out of it: {}.", fmt::join(expectation.left_out, ", ")));
  return table;
}

PageTable app_table(const score::LogScore& score) {
  const score::Scorer& scorer = score.scorer;
  const score::SolutionCounts& counts = scorer.counts();
  const auto of = [&](Metric metric) { return shown(score::figure(scorer, metric, {})); };
  PageTable table{"Navigation app", {"", ""}, {}, {}, 1, page_id::kApp};
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

PageTable profiles_table(const evidence::LogSummary& summary) {
  PageTable table{"Profiles", {"profile", "sensor", "kind", "from, s"}, {}, {}, 3};
  for (const evidence::ProfileInUse& entry : summary.profiles) {
    const std::string& name = catalog::name_of(entry.profile);
    if (entry.apply_at_ns < 0 && name.empty()) continue;  // the scenario names none
    table.rows.push_back(
        {name.empty() ? "(no name)" : name, catalog::sensor_name(catalog::target_of(entry.profile)),
         std::string(enum_name(catalog::kind_of(entry.profile))),
         entry.apply_at_ns < 0 ? "the start" : fmt::format("{:.3f}", time::to_seconds(entry.apply_at_ns))});
  }
  return table;
}

/// The measured value in the colour of its check.
Cell measured_cell(const evidence::Measured& measured) {
  return {fmt::format("{:.5g}", measured.value), measured.holds ? Tone::Good : Tone::Bad};
}

PageTable swaps_table(const std::vector<evidence::SwapEvidence>& swaps) {
  PageTable table{"Swaps",
                  {"swap", "quantity", "unit", "before: measured", "promised", "after: measured", "promised"},
                  {},
                  "Measured in the samples up to 20 s before and after each swap; promised by the two profiles. Green "
                  "lies within four standard errors of the promise.",
                  3};
  std::size_t number = 0;
  for (const evidence::SwapEvidence& swap : swaps) {
    const std::string name =
        fmt::format("{}: {} '{}' for {} from {:.3f} s on{}{}", ++number, enum_name(swap.ack.kind), swap.profile_name,
                    catalog::sensor_name(swap.ack.target), time::to_seconds(swap.ack.apply_time_ns),
                    swap.first_sample_holds ? "" : "; its first sample is not the acknowledged one",
                    swap.left_out.empty() ? "" : fmt::format("; not weighed: {}", fmt::join(swap.left_out, ", ")));
    const Cell first{name, swap.first_sample_holds ? Tone::Plain : Tone::Bad};
    if (swap.lines.empty()) table.rows.push_back({first, "nothing measured: " + swap.why_nothing, "", "", "", "", ""});
    for (const evidence::EvidenceLine& line : swap.lines) {
      table.rows.push_back({&line == &swap.lines.front() ? first : Cell(""), line.quantity, line.unit,
                            measured_cell(line.before), fmt::format("{:.5g}", line.before.promised),
                            measured_cell(line.after), fmt::format("{:.5g}", line.after.promised)});
    }
  }
  return table;
}

}  // namespace

std::vector<PageTable> report_tables(const ReportData& data) {
  const score::SwapIntervals& intervals = data.score.intervals;
  const bool has_outages = !data.score.scorer.outages().empty();
  std::vector<PageTable> tables;
  for (PageTable& table :
       std::vector<PageTable>{acceptance_table(data.score, intervals), phases_table(data.score, intervals),
                              outages_table(data.score, data.expectation), ratios_table(data, has_outages),
                              app_table(data.score), swaps_table(data.swaps), profiles_table(data.summary)}) {
    if (!table.rows.empty()) tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace inslab::report
