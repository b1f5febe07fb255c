#include "inslab/referee/score/score_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/foundation/files/xml_text.hpp"

namespace inslab::score {

namespace {

using scenario::Metric;

std::string shown(const std::optional<double>& value) { return value ? fmt::format("{:.4g}", *value) : "-"; }

std::string latency_text(const Scorer& scorer) {
  if (!scorer.latency().why_none().empty()) return "  latency: not judged, " + scorer.latency().why_none() + "\n";
  const auto of = [&](Metric metric) { return shown(figure(scorer, metric, {})); };
  std::string text = fmt::format("  latency (IMU sample sent to solution received): p50 {}, p99 {}, max {} ms\n",
                                 of(Metric::LatencyP50), of(Metric::LatencyP99), of(Metric::LatencyMax));
  if (scorer.latency().negative() > 0) {
    text +=
        fmt::format("  {} latencies are negative: the hosts' clocks are unsynchronised\n", scorer.latency().negative());
  }
  return text;
}

std::string counts_text(const Scorer& scorer) {
  const SolutionCounts& counts = scorer.counts();
  const auto of = [&](Metric metric) { return shown(figure(scorer, metric, {})); };
  std::string text = fmt::format("\nnavigation app: {} solutions received, {} scored", counts.received, counts.scored);
  if (counts.received == 0) return text + "\n";
  text += fmt::format("; stale {}, future {}, not finite {}, twice {}, out of order {}{}\n", counts.stale,
                      counts.future, counts.non_finite, counts.duplicates, counts.out_of_order,
                      counts.too_many > 0 ? fmt::format(", too many {}", counts.too_many) : "");
  text += "  modes:";
  for (std::size_t i = 0; i < counts.modes.size(); ++i) {
    text += fmt::format(" {} {}{}", EnumNames<NavMode>::values[i], counts.modes[i],
                        i + 1 < counts.modes.size() ? "," : "\n");
  }
  text += fmt::format("  first solution at {} s; {} Hz; longest gap {} s, {} gaps\n", of(Metric::TimeToFirstSolution),
                      of(Metric::Rate), of(Metric::LongestGap), scorer.rhythm().gaps());
  return text + latency_text(scorer);
}

std::string phases_text(const Scorer& scorer, const std::vector<Verdict>& verdicts) {
  constexpr const char* kColumns = "{:<32}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>11}{:>11}{:>11}\n";
  std::string text = "\n";
  text += fmt::format(kColumns, "errors", "solutions", "hor RMS", "CEP50", "CEP95", "ver RMS", "vel RMS", "tilt RMS",
                      "head RMS", "NEES p", "NEES v", "NEES a");
  text += fmt::format(kColumns, "", "", "m", "m", "m", "m", "m/s", "deg", "deg", "(3)", "(3)", "(3)");
  for (const auto& [key, errors] : scorer.phases()) {
    if (!is_shown(key, scorer, verdicts)) continue;
    const auto of = [&, &phase = key](Metric metric) { return shown(figure(scorer, metric, phase)); };
    text += fmt::format(kColumns, words_of(key), errors.count(), of(Metric::HorizontalRms), of(Metric::Cep50),
                        of(Metric::Cep95), of(Metric::VerticalRms), of(Metric::VelocityRms), of(Metric::TiltRms),
                        of(Metric::HeadingRms), of(Metric::PositionNees), of(Metric::VelocityNees),
                        of(Metric::AttitudeNees));
  }
  return text + "NEES: squared error over the app's own variance; 3 is expected of an app that knows how good it is\n";
}

std::string outages_text(const Scorer& scorer) {
  if (scorer.outages().empty()) return "";
  return fmt::format(
      "\n{} outage{}; largest error in each, RMS over them: horizontal {} m, vertical {} m; worst {} m, "
      "{} m\n",
      scorer.outages().size(), scorer.outages().size() == 1 ? "" : "s",
      shown(figure(scorer, Metric::OutageDriftRms, {})), shown(figure(scorer, Metric::OutageVerticalDriftRms, {})),
      shown(figure(scorer, Metric::OutageDriftMax, {})), shown(figure(scorer, Metric::OutageVerticalDriftMax, {})));
}

}  // namespace

bool is_shown(const PhaseKey& key, const Scorer& scorer, const std::vector<Verdict>& verdicts) {
  const auto asks = [&key](const Verdict& verdict) {
    const scenario::AcceptanceLimit& limit = verdict.limit;
    return !is_of_the_run(limit.metric) && limit.phase == key.phase && limit.swap_interval == key.swap_interval &&
           limit.after_s == key.after_s;
  };
  if (std::any_of(verdicts.begin(), verdicts.end(), asks)) return true;
  if (key.after_s > 0.0) return false;
  switch (key.phase) {
    case scenario::Phase::All:
    case scenario::Phase::Outages:
      return true;
    case scenario::Phase::BetweenOutages:
      return !scorer.outages().empty();
    case scenario::Phase::SwapInterval:
      return scorer.phases().count({scenario::Phase::SwapInterval, 1, 0.0}) > 0;
  }
  return true;
}

std::string score_so_far(const Scorer& scorer) {
  const SolutionCounts& counts = scorer.counts();
  if (counts.received == 0) return "";
  std::string words = fmt::format("app: {} solutions", counts.received);
  if (counts.scored == 0) return words + ", none scored yet";
  const auto of = [&scorer](Metric metric) { return shown(figure(scorer, metric, {})); };
  return words + fmt::format(
                     "; errors of the first {}: horizontal RMS {} m, largest {} m; vertical RMS {} m; "
                     "attitude RMS {} deg tilt, {} deg heading",
                     counts.scored, of(Metric::HorizontalRms), of(Metric::HorizontalMax), of(Metric::VerticalRms),
                     of(Metric::TiltRms), of(Metric::HeadingRms));
}

std::string score_text(const Scorer& scorer, const std::vector<Verdict>& verdicts) {
  std::string text = counts_text(scorer);
  if (scorer.counts().scored > 0) text += phases_text(scorer, verdicts) + outages_text(scorer);
  if (!verdicts.empty()) text += "\n";
  for (const Verdict& verdict : verdicts) {
    text += fmt::format("{}  {}: {}{}\n", verdict.passed ? "PASS" : "FAIL", words_of(verdict.limit),
                        shown(verdict.value), verdict.passed ? "" : " (" + verdict.why + ")");
  }
  return text;
}

std::string junit_xml(const std::string& suite, const std::vector<Verdict>& verdicts) {
  std::size_t failures = 0;
  for (const Verdict& verdict : verdicts) failures += verdict.passed ? 0 : 1;
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n  <testsuite name=\"{}\" tests=\"{}\" "
      "failures=\"{}\" errors=\"0\">\n",
      files::xml_text(suite), verdicts.size(), failures);
  for (const Verdict& verdict : verdicts) {
    xml +=
        fmt::format("    <testcase classname=\"acceptance\" name=\"{}\">\n", files::xml_text(words_of(verdict.limit)));
    if (!verdict.passed) xml += fmt::format("      <failure message=\"{}\"/>\n", files::xml_text(verdict.why));
    if (verdict.value) xml += fmt::format("      <system-out>{:.9g}</system-out>\n", *verdict.value);
    xml += "    </testcase>\n";
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace inslab::score
