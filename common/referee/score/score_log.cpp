#include "inslab/referee/score/score_log.hpp"

#include <algorithm>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"
#include "inslab/formats/log/log_topic.hpp"

namespace inslab::score {

namespace {

/// Gives a message to `take` when it is of the type T; true when it was.
template <class T, class Take>
bool taken(const std::string& type, const mcap::Message& message, const Take& take) {
  if (type != catalog::WireType<T>::name) return false;
  T sample;
  if (wire::decode(message.data, message.size, sample)) take(sample);
  return true;
}

/// Truth and fixes, which are what solutions are measured by.
bool took_what_is_true(const std::string& type, const mcap::Message& message, Scorer& scorer) {
  const auto add = [&scorer](const auto& sample) { scorer.add(sample); };
  return taken<TruthState>(type, message, add) || taken<GnssFix>(type, message, add);
}

/// With the installations that the log says were in use.
Scorer scorer_of(const evidence::LogSummary& summary, const Scorer::Options& options) {
  Scorer scorer(summary.scenario, options);
  for (const evidence::ProfileInUse& entry : summary.profiles) {
    const auto* installation = std::get_if<InstallationProfile>(&entry.profile);
    if (installation != nullptr) scorer.add(*installation, entry.apply_at_ns);
  }
  return scorer;
}

Scorer::Options told(Scorer::Options options, LogScorer::OnScored on_scored) {
  options.on_scored = std::move(on_scored);
  return options;
}

}  // namespace

bool LogScore::accepted() const {
  return std::all_of(verdicts.begin(), verdicts.end(), [](const Verdict& verdict) { return verdict.passed; });
}

LogScorer::LogScorer(const evidence::LogSummary& summary, OnScored on_scored)
    : summary_(summary),
      on_scored_(std::move(on_scored)),
      scorer_(scorer_of(summary, told(Scorer::Options(), [this](const ScoredSolution& scored) {
                          worst_.add(scored);
                          if (on_scored_) on_scored_(scored);
                        }))) {
  if (summary.last_status && summary.last_status->clock == ClockMode::Lockstep) {
    scorer_.without_latency(kLockstepHasNoLatency);
  }
}

void LogScorer::take_part(log::LogWalk& walk) {
  const auto add = [this](const auto& sample) { scorer_.add(sample); };
  walk.each<TruthState>(add);
  walk.each<GnssFix>(add);
  walk.each<ImuSample>(add);
  walk.each<NavSolution>([this](const NavSolution& solution, const log::LogWalk::Place& place) {
    scorer_.add(solution, place.log_time_ns);
  });
}

LogScore LogScorer::finish() {
  scorer_.finish();
  std::vector<Verdict> verdicts = judge(scorer_, summary_.scenario.acceptance);
  return {std::move(scorer_), std::move(verdicts), worst_, SwapIntervals(summary_)};
}

LogScore score_log(const mcap::McapReader& log, const evidence::LogSummary& summary) {
  LogScorer scorer(summary);
  log::LogWalk walk(log);
  scorer.take_part(walk);
  walk.go();
  return scorer.finish();
}

LogScore score_app(const mcap::McapReader& log, const evidence::LogSummary& summary, const OfflineApp& app) {
  const auto imu = log::needed_channels_of(log, catalog::stream_topic<ImuSample>(app.imu_number),
                                           catalog::WireType<ImuSample>::name);
  Scorer::Options options;
  options.imu_number = app.imu_number;
  options.gnss_number = app.gnss_number;
  LogScore result{scorer_of(summary, options), {}, {}, SwapIntervals(summary)};
  Scorer& scorer = result.scorer;
  scorer.without_latency("the app ran on a log");
  const auto types = log::channel_types(log);
  log.for_each(
      [&](const mcap::Message& message) {
        const std::string& type = types.at(message.channel_id);
        if (imu.count(message.channel_id) == 0) {
          took_what_is_true(type, message, scorer);
          return true;
        }
        taken<ImuSample>(type, message, [&](const ImuSample& sample) {
          scorer.add(sample);
          if (const auto solution = app.answer(sample)) scorer.add(*solution, 0);
        });
        return true;
      },
      mcap::McapReader::Order::LogTime);
  scorer.finish();
  return result;
}

}  // namespace inslab::score
