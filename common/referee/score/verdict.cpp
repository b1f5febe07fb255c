#include "inslab/referee/score/verdict.hpp"

#include <cstdio>

#include "inslab/foundation/units/units.hpp"

namespace inslab::score {

namespace {

using scenario::Metric;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Root mean square over the outages that hold a solution.
std::optional<double> drift(const Scorer& scorer, double OutageDrift::*size, bool largest) {
  double sum = 0.0, most = 0.0;
  std::uint64_t count = 0;
  for (const OutageDrift& outage : scorer.outages()) {
    if (outage.solutions == 0) continue;
    ++count;
    sum += outage.*size * outage.*size;
    most = std::max(most, outage.*size);
  }
  if (count == 0) return std::nullopt;
  return largest ? most : std::sqrt(sum / static_cast<double>(count));
}

std::optional<double> scaled(const std::optional<double>& value, double factor) {
  return value ? std::optional<double>(*value * factor) : std::nullopt;
}

std::optional<double> figure_of_the_run(const Scorer& scorer, Metric metric) {
  const SolutionCounts& counts = scorer.counts();
  const Quantiles& latency = scorer.latency().seconds();
  if (counts.received == 0) return std::nullopt;
  if (scenario::is_latency(metric) && !scorer.latency().why_none().empty()) return std::nullopt;
  switch (metric) {
    case Metric::OutageDriftRms:
      return drift(scorer, &OutageDrift::horizontal_m, false);
    case Metric::OutageDriftMax:
      return drift(scorer, &OutageDrift::horizontal_m, true);
    case Metric::OutageVerticalDriftRms:
      return drift(scorer, &OutageDrift::vertical_m, false);
    case Metric::OutageVerticalDriftMax:
      return drift(scorer, &OutageDrift::vertical_m, true);
    case Metric::LatencyP50:
      return scaled(latency.at(0.5), 1e3);
    case Metric::LatencyP99:
      return scaled(latency.at(0.99), 1e3);
    case Metric::LatencyMax:
      return latency.count() == 0 ? std::nullopt : std::optional(latency.largest() * 1e3);
    case Metric::Rate:
      return scorer.rhythm().rate_hz();
    case Metric::LongestGap:
      return scorer.rhythm().longest_gap_s();
    case Metric::TimeToFirstSolution:
      return scorer.rhythm().first_solution_s();
    case Metric::Stale:
      return static_cast<double>(counts.stale);
    case Metric::Future:
      return static_cast<double>(counts.future);
    case Metric::NonFinite:
      return static_cast<double>(counts.non_finite);
    case Metric::Duplicates:
      return static_cast<double>(counts.duplicates);
    case Metric::OutOfOrder:
      return static_cast<double>(counts.out_of_order);
    default:
      return std::nullopt;
  }
}

std::optional<double> figure_of(const ErrorStatistics& errors, Metric metric) {
  if (errors.count() == 0) return std::nullopt;
  const Vector3 position = errors.position().rms(errors.count());
  const Vector3 phi = errors.phi().rms(errors.count()) * units::kDegPerRad;
  switch (metric) {
    case Metric::HorizontalRms:
      return position.head<2>().norm();
    case Metric::HorizontalMax:
      return errors.horizontal_m().largest();
    case Metric::Cep50:
      return errors.horizontal_m().at(0.5);
    case Metric::Cep95:
      return errors.horizontal_m().at(0.95);
    case Metric::VerticalRms:
      return position.z();
    case Metric::VerticalMax:
      return errors.vertical_m().largest();
    case Metric::Vertical50:
      return errors.vertical_m().at(0.5);
    case Metric::Vertical95:
      return errors.vertical_m().at(0.95);
    case Metric::VelocityRms:
      return errors.velocity().rms(errors.count()).norm();
    case Metric::TiltRms:
      return phi.head<2>().norm();
    case Metric::HeadingRms:
      return phi.z();
    case Metric::PositionNees:
      return errors.position_nees().mean();
    case Metric::VelocityNees:
      return errors.velocity_nees().mean();
    case Metric::AttitudeNees:
      return errors.attitude_nees().mean();
    default:
      return std::nullopt;
  }
}

/// Why a phase cannot speak for the app; empty when it can.
std::string not_covered(const Scorer& scorer, const PhaseKey& key) {
  const auto found = scorer.phases().find(key);
  if (scorer.counts().received == 0) return "no solution came: the app is missing";
  if (found == scorer.phases().end() || found->second.time_s() == 0.0) return "the run had no such phase";
  const ErrorStatistics& errors = found->second;
  if (errors.covered_s() >= kLeastCover * errors.time_s()) return "";
  return "solutions cover " + number(errors.covered_s()) + " s of " + number(errors.time_s()) + " s";
}

}  // namespace

std::optional<double> figure(const Scorer& scorer, Metric metric, const PhaseKey& phase) {
  if (scenario::is_of_the_run(metric)) return figure_of_the_run(scorer, metric);
  const auto found = scorer.phases().find(phase);
  return found == scorer.phases().end() ? std::nullopt : figure_of(found->second, metric);
}

std::vector<Verdict> judge(const Scorer& scorer, const std::vector<scenario::AcceptanceLimit>& acceptance) {
  std::vector<Verdict> verdicts;
  for (const scenario::AcceptanceLimit& limit : acceptance) {
    const PhaseKey phase{limit.phase, limit.swap_interval, limit.after_s};
    Verdict verdict{limit, figure(scorer, limit.metric, phase), false, ""};
    if (scorer.counts().scored == 0) {
      verdict.why = scorer.counts().received == 0 ? "no solution came: the app is missing" : "no solution was scored";
    } else if (!scenario::is_of_the_run(limit.metric)) {
      verdict.why = not_covered(scorer, phase);
    }
    if (verdict.why.empty() && scenario::is_latency(limit.metric)) verdict.why = scorer.latency().why_none();
    if (verdict.why.empty() && !verdict.value) verdict.why = "there is no such figure";
    if (verdict.why.empty() && limit.at_most && !(*verdict.value <= *limit.at_most)) {
      verdict.why = number(*verdict.value) + " is above " + number(*limit.at_most);
    }
    if (verdict.why.empty() && limit.at_least && !(*verdict.value >= *limit.at_least)) {
      verdict.why = number(*verdict.value) + " is below " + number(*limit.at_least);
    }
    verdict.passed = verdict.why.empty();
    verdicts.push_back(verdict);
  }
  return verdicts;
}

std::string words_of(const PhaseKey& phase) {
  std::string words(enum_name(phase.phase));
  if (phase.phase == scenario::Phase::SwapInterval) words += " " + std::to_string(phase.swap_interval);
  if (phase.after_s > 0.0) words += ", after " + number(phase.after_s) + " s";
  return words;
}

std::string words_of(const scenario::AcceptanceLimit& limit) {
  std::string words(enum_name(limit.metric));
  if (limit.phase != scenario::Phase::All || limit.after_s > 0.0) {
    words += ", " + words_of(PhaseKey{limit.phase, limit.swap_interval, limit.after_s});
  }
  if (limit.at_least) words += ", at least " + number(*limit.at_least);
  if (limit.at_most) words += ", at most " + number(*limit.at_most);
  return words;
}

}  // namespace inslab::score
