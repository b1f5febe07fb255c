#include "inslab/referee/score/score_json.hpp"

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::score {

namespace {

using Json = nlohmann::ordered_json;
using scenario::Metric;

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const Vector3& value) { return Json::array({value.x(), value.y(), value.z()}); }

Metric metric_of(std::size_t index) { return static_cast<Metric>(index); }

Json phase_json(const Scorer& scorer, const PhaseKey& key, const ErrorStatistics& errors) {
  Json phase{{"phase", enum_name(key.phase)}, {"swap_interval", key.swap_interval}, {"after_s", key.after_s},
             {"solutions", errors.count()},   {"time_s", errors.time_s()},          {"covered_s", errors.covered_s()}};
  for (std::size_t i = 0; i < EnumNames<Metric>::values.size(); ++i) {
    if (scenario::is_of_the_run(metric_of(i))) continue;
    phase[std::string(EnumNames<Metric>::values[i])] = json_of(figure(scorer, metric_of(i), key));
  }
  if (errors.count() > 0) {
    phase["position_mean_ned_m"] = json_of(errors.position().mean(errors.count()));
    phase["position_rms_ned_m"] = json_of(errors.position().rms(errors.count()));
    phase["position_max_ned_m"] = json_of(errors.position().largest);
    phase["velocity_mean_ned_m_per_s"] = json_of(errors.velocity().mean(errors.count()));
    phase["velocity_rms_ned_m_per_s"] = json_of(errors.velocity().rms(errors.count()));
    phase["velocity_max_ned_m_per_s"] = json_of(errors.velocity().largest);
    phase["phi_mean_ned_rad"] = json_of(errors.phi().mean(errors.count()));
    phase["phi_rms_ned_rad"] = json_of(errors.phi().rms(errors.count()));
    phase["phi_max_ned_rad"] = json_of(errors.phi().largest);
  }
  phase["position_nees_solutions"] = errors.position_nees().count;
  phase["velocity_nees_solutions"] = errors.velocity_nees().count;
  phase["attitude_nees_solutions"] = errors.attitude_nees().count;
  return phase;
}

}  // namespace

Json score_json(const Scorer& scorer, const std::vector<Verdict>& verdicts) {
  const SolutionCounts& counts = scorer.counts();
  Json score{{"received", counts.received},
             {"scored", counts.scored},
             {"too_many", counts.too_many},
             {"gaps", scorer.rhythm().gaps()},
             {"latencies", scorer.latency().seconds().count()},
             {"negative_latencies", scorer.latency().negative()},
             {"why_no_latency", scorer.latency().why_none()}};
  for (std::size_t i = 0; i < counts.modes.size(); ++i) {
    score["modes"][std::string(EnumNames<NavMode>::values[i])] = counts.modes[i];
  }
  for (std::size_t i = 0; i < EnumNames<Metric>::values.size(); ++i) {
    if (!scenario::is_of_the_run(metric_of(i))) continue;
    score[std::string(EnumNames<Metric>::values[i])] = json_of(figure(scorer, metric_of(i), {}));
  }
  score["phases"] = Json::array();
  for (const auto& [key, errors] : scorer.phases()) score["phases"].push_back(phase_json(scorer, key, errors));
  score["outages"] = Json::array();
  for (const OutageDrift& outage : scorer.outages()) {
    score["outages"].push_back({{"begin_s", time::to_seconds(outage.begin_ns)},
                                {"end_s", time::to_seconds(outage.end_ns)},
                                {"solutions", outage.solutions},
                                {"horizontal_m", outage.horizontal_m},
                                {"vertical_m", outage.vertical_m}});
  }
  score["acceptance"] = Json::array();
  for (const Verdict& verdict : verdicts) {
    score["acceptance"].push_back({{"line", words_of(verdict.limit)},
                                   {"value", json_of(verdict.value)},
                                   {"passed", verdict.passed},
                                   {"why", verdict.why}});
  }
  return score;
}

}  // namespace inslab::score
