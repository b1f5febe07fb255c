#include "inslab/referee/score/score_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/score/score_text.hpp"

namespace inslab::score {

namespace {

using scenario::Metric;
using scenario::Phase;

constexpr double kStands_m_per_s = 0.05;
constexpr double kTurns_deg_per_s = 1.0;

std::string outage_words(const Moment& moment, const LogScore& score) {
  for (const OutageDrift& outage : score.scorer.outages()) {
    const double begin_s = time::to_seconds(outage.begin_ns), end_s = time::to_seconds(outage.end_ns);
    if (moment.time_s < begin_s || moment.time_s > end_s) continue;
    return fmt::format(", {:.2f} s after the last fix (outage from {:.2f} s to {:.2f} s)", moment.time_s - begin_s,
                       begin_s, end_s);
  }
  return score.scorer.outages().empty() ? "" : ", with fixes";
}

std::string motion_words(const Moment& moment) {
  if (moment.speed_m_per_s < kStands_m_per_s) return ", at rest";
  std::string words = fmt::format(", at {:.1f} m/s", moment.speed_m_per_s);
  if (std::abs(moment.turn_rate_deg_per_s) >= kTurns_deg_per_s) {
    words += fmt::format(", turning {} at {:.1f} deg/s", moment.turn_rate_deg_per_s > 0.0 ? "right" : "left",
                         std::abs(moment.turn_rate_deg_per_s));
  }
  return words;
}

bool limits_an_error(const Verdict& verdict) { return !scenario::is_of_the_run(verdict.limit.metric); }

bool limits_a_drift(const Verdict& verdict) {
  const Metric metric = verdict.limit.metric;
  return metric >= Metric::OutageDriftRms && metric <= Metric::OutageVerticalDriftMax;
}

std::string intervals_text(const LogScore& score) {
  const SwapIntervals& intervals = score.intervals;
  std::string text;
  for (const auto& [key, errors] : score.scorer.phases()) {
    if (key.phase != Phase::SwapInterval || key.after_s > 0.0 || key.swap_interval == 0) continue;
    text += fmt::format("swap_interval {}: after {}\n", key.swap_interval, intervals.name(key.swap_interval));
  }
  return text.empty() ? text : "\n" + text;
}

}  // namespace

std::string worst_words(const LogScore& score) {
  if (!score.worst.found()) return "";
  const Moment& moment = *score.worst.found();
  std::string words = fmt::format("{:.4g} m horizontally and {:.4g} m vertically at {:.3f} s", moment.horizontal_m,
                                  moment.vertical_m, moment.time_s);
  words += outage_words(moment, score) + motion_words(moment);
  if (moment.horizontal_sigma_m > 0.0) {
    words += fmt::format("; the app's own 1 sigma was {:.4g} m, so the error was {:.3g} times as large",
                         moment.horizontal_sigma_m, moment.horizontal_m / moment.horizontal_sigma_m);
  }
  const SwapIntervals& intervals = score.intervals;
  const std::size_t interval = intervals.at(moment.time_s);
  if (interval > 0) words += "; the last swap before it: " + intervals.name(interval);
  return words;
}

std::string unjudged_words(const LogScore& score) {
  const auto& verdicts = score.verdicts;
  if (verdicts.empty()) return "";
  const auto all_of_errors = [&](const auto& holds) {
    return std::all_of(verdicts.begin(), verdicts.end(),
                       [&](const Verdict& verdict) { return !limits_an_error(verdict) || holds(verdict.limit); });
  };
  const bool has_drifts = std::any_of(verdicts.begin(), verdicts.end(), limits_a_drift);
  if (!has_drifts && std::none_of(verdicts.begin(), verdicts.end(), limits_an_error)) return "no error is judged";
  const SwapIntervals& intervals = score.intervals;
  if (!has_drifts && intervals.count() > 0 && all_of_errors([](const scenario::AcceptanceLimit& limit) {
        return limit.phase == Phase::SwapInterval && limit.swap_interval == 0;
      })) {
    return fmt::format("errors are judged only before the first swap, at {:.3f} s", intervals.begin_s(1));
  }
  if (!has_drifts && !score.scorer.outages().empty() &&
      all_of_errors([](const scenario::AcceptanceLimit& limit) { return limit.phase == Phase::BetweenOutages; })) {
    return "errors in outages are not judged";
  }
  return "";
}

std::string verdict_words(const LogScore& score) {
  if (score.verdicts.empty()) return "";
  const auto passed = std::count_if(score.verdicts.begin(), score.verdicts.end(),
                                    [](const Verdict& verdict) { return verdict.passed; });
  const std::string unjudged = unjudged_words(score);
  return fmt::format("{}: {} of {} acceptance lines passed{}{}", score.accepted() ? "PASS" : "FAIL", passed,
                     score.verdicts.size(), unjudged.empty() ? "" : "; ", unjudged);
}

std::string score_words(const LogScore& score) {
  std::string text = score_text(score.scorer, score.verdicts);
  const std::string worst = worst_words(score), verdict = verdict_words(score);
  if (!verdict.empty()) text += verdict + "\n";
  if (!worst.empty()) text += "\nworst moment: " + worst + "\n";
  return text + intervals_text(score);
}

}  // namespace inslab::score
