#include "inslab/referee/montecarlo/summary_text.hpp"

#include <fmt/format.h>

#include "inslab/referee/score/verdict.hpp"

namespace inslab::montecarlo {

namespace {

using scenario::Metric;
using scenario::Phase;

std::string shown(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "-"; }

/// "1.317 [1.284, 1.351]".
std::string shown(const Estimate& estimate) {
  return fmt::format("{:.4g} [{}, {}]", estimate.value, shown(estimate.low), shown(estimate.high));
}

/// Those that text has room for, of the many in JSON.
bool is_in_text(Metric metric) {
  constexpr Metric kShown[] = {Metric::HorizontalRms,
                               Metric::Cep50,
                               Metric::Cep95,
                               Metric::VerticalRms,
                               Metric::VelocityRms,
                               Metric::TiltRms,
                               Metric::HeadingRms,
                               Metric::PositionNees,
                               Metric::VelocityNees,
                               Metric::AttitudeNees,
                               Metric::OutageDriftRms,
                               Metric::OutageDriftMax,
                               Metric::OutageVerticalDriftRms,
                               Metric::OutageVerticalDriftMax,
                               Metric::TimeToFirstSolution};
  for (const Metric shown : kShown) {
    if (shown == metric) return true;
  }
  return false;
}

std::string head_text(const Summary& s) {
  std::string text = fmt::format("{}: {} of {} runs, seeds {} to {}\n", s.name, s.succeeded, s.wanted, s.first_seed,
                                 s.first_seed + s.wanted - 1);
  for (const FailedRun& run : s.failed) {
    text += fmt::format("FAILED  run {}, seed {}: {}\n", run.run, run.seed, run.reason);
  }
  if (!s.missing.empty()) {
    text += fmt::format("MISSING {} run{}, the first is run {}\n", s.missing.size(), s.missing.size() == 1 ? "" : "s",
                        s.missing.front());
  }
  return text;
}

std::string columns(const std::string& what, const std::string& runs, const std::string& mean, const std::string& rms,
                    const std::string& p50, const std::string& p95, const std::string& p99) {
  return fmt::format("{:<48}{:>6}  {:<34}{:<34}{:<34}{:<34}{}\n", what, runs, mean, rms, p50, p95, p99);
}

std::string row(const std::string& what, const Distribution& d) {
  return columns(what, std::to_string(d.values.size()), shown(d.mean), shown(d.rms), shown(d.p50), shown(d.p95),
                 shown(d.p99));
}

std::string figures_text(const Summary& s) {
  bool has_swaps = false, has_outages = false;
  for (const FigureSummary& figure : s.figures) {
    has_swaps |= figure.figure.swap_interval > 0;
    has_outages |= figure.figure.phase == Phase::Outages;
  }
  std::string text =
      "\n" + columns("of each run, over the runs [95 % confidence]", "runs", "mean", "RMS", "50 %", "95 %", "99 %");
  for (const FigureSummary& figure : s.figures) {
    const RunFigure& f = figure.figure;
    if (!is_in_text(f.metric) || (f.phase == Phase::SwapInterval && !has_swaps)) continue;
    if (f.phase == Phase::BetweenOutages && !has_outages) continue;  // the same as all
    std::string what(enum_name(f.metric));
    if (!scenario::is_of_the_run(f.metric)) what += ", " + score::words_of({f.phase, f.swap_interval, f.after_s});
    text += row(what, figure.over_runs);
  }
  return text;
}

std::string outages_text(const Summary& s) {
  if (s.outages.empty()) return "";
  std::string text = "\n" + columns("largest error in each outage", "runs", "mean", "RMS", "50 %", "95 %", "99 %");
  for (const OutageSummary& outage : s.outages) {
    const std::string when = fmt::format("{:.1f} to {:.1f} s", outage.begin_s, outage.end_s);
    text += row(when + ", horizontal_m", outage.horizontal_m) + row(when + ", vertical_m", outage.vertical_m);
  }
  return text;
}

std::string end_text(const Summary& s) {
  if (s.instants.empty()) return "";
  const InstantSummary& end = s.instants.back();
  std::string text = fmt::format("\nat {:.3f} s, over {} runs; reported sigma beside it\n", end.time_s, end.runs);
  const auto line = [&](const char* what, const Believed& b) {
    text += fmt::format("  {:<18}RMS {:<30} sigma {:.4g}\n", what, shown(b.rms), b.sigma);
  };
  line("horizontal, m", end.horizontal_m);
  line("vertical, m", end.vertical_m);
  line("velocity, m/s", end.velocity_m_per_s);
  line("tilt, deg", end.tilt_deg);
  line("heading, deg", end.heading_deg);
  text += fmt::format("  CEP50 {} m, CEP95 {} m\n", shown(end.cep50_m), shown(end.cep95_m));
  text += fmt::format("\nNEES of position, velocity and attitude, 9 is expected: mean {}\n", shown(*s.nees));
  text += fmt::format(
      "  at {} of {} instants the mean over the runs is outside its 95 % band, {:.3g} to {:.3g} at the end\n",
      s.nees_instants_out, s.instants.size(), end.nees_band.low, end.nees_band.high);
  return text;
}

std::string acceptance_text(const Summary& s) {
  std::string text = s.acceptance.empty() ? "" : "\nacceptance: runs that passed\n";
  for (const LineSummary& line : s.acceptance) {
    text += line.judged ? fmt::format("  {} of {}, share {}: {}{}\n", line.passed, s.succeeded, shown(line.share),
                                      line.line, line.why.empty() ? "" : " (" + line.why + ")")
                        : fmt::format("  not judged: {} ({})\n", line.line, line.why);
  }
  return text;
}

json::Json json_of(const Estimate& e) {
  const auto bound = [](const std::optional<double>& value) {
    return value ? json::Json(*value) : json::Json(nullptr);
  };
  return {{"value", e.value}, {"low", bound(e.low)}, {"high", bound(e.high)}};
}

json::Json json_of(const Distribution& d) {
  return {{"runs", d.values.size()}, {"mean", json_of(d.mean)}, {"rms", json_of(d.rms)},
          {"p50", json_of(d.p50)},   {"p95", json_of(d.p95)},   {"p99", json_of(d.p99)}};
}

json::Json json_of(const Believed& b) { return {{"rms", json_of(b.rms)}, {"sigma", b.sigma}}; }

json::Json json_of(const FigureSummary& f) {
  json::Json json{{"metric", enum_name(f.figure.metric)},
                  {"phase", enum_name(f.figure.phase)},
                  {"swap_interval", f.figure.swap_interval},
                  {"after_s", f.figure.after_s}};
  json.update(json_of(f.over_runs));
  return json;
}

json::Json json_of(const InstantSummary& i) {
  return {{"time_s", i.time_s},
          {"runs", i.runs},
          {"horizontal_m", json_of(i.horizontal_m)},
          {"vertical_m", json_of(i.vertical_m)},
          {"velocity_m_per_s", json_of(i.velocity_m_per_s)},
          {"tilt_deg", json_of(i.tilt_deg)},
          {"heading_deg", json_of(i.heading_deg)},
          {"cep50_m", json_of(i.cep50_m)},
          {"cep95_m", json_of(i.cep95_m)},
          {"nees", {{"mean", i.nees}, {"low", i.nees_band.low}, {"high", i.nees_band.high}}}};
}

}  // namespace

std::string summary_text(const Summary& summary) {
  if (summary.succeeded == 0) return head_text(summary);
  return head_text(summary) + figures_text(summary) + outages_text(summary) + end_text(summary) +
         acceptance_text(summary);
}

json::Json summary_json(const Summary& s) {
  using json::Json;
  Json json{{"name", s.name},           {"fingerprint", s.fingerprint}, {"first_seed", s.first_seed},
            {"wanted", s.wanted},       {"succeeded", s.succeeded},     {"failed", Json::array()},
            {"missing", s.missing},     {"confidence", kConfidence},    {"figures", Json::array()},
            {"outages", Json::array()}, {"instants", Json::array()},    {"acceptance", Json::array()}};
  for (const FailedRun& run : s.failed) {
    json["failed"].push_back({{"run", run.run}, {"seed", run.seed}, {"reason", run.reason}});
  }
  for (const FigureSummary& figure : s.figures) json["figures"].push_back(json_of(figure));
  for (const OutageSummary& o : s.outages) {
    json["outages"].push_back({{"begin_s", o.begin_s},
                               {"end_s", o.end_s},
                               {"horizontal_m", json_of(o.horizontal_m)},
                               {"vertical_m", json_of(o.vertical_m)}});
  }
  for (const InstantSummary& instant : s.instants) json["instants"].push_back(json_of(instant));
  json["nees"] = s.nees ? json_of(*s.nees) : Json(nullptr);
  json["nees_instants_outside_their_band"] = s.nees_instants_out;
  for (const LineSummary& line : s.acceptance) {
    json["acceptance"].push_back({{"line", line.line},
                                  {"judged", line.judged},
                                  {"passed", line.passed},
                                  {"share", line.judged ? json_of(line.share) : Json(nullptr)},
                                  {"why", line.why}});
  }
  return json;
}

}  // namespace inslab::montecarlo
