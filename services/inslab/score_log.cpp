#include "services/inslab/score_log.hpp"

#include <algorithm>

#include "wire/cdr.hpp"
#include "wire/wire_type.hpp"

namespace inslab::cli {

namespace {

/// Gives a message to `take` when it is of the type T; true when it was.
template <class T, class Take>
bool taken(const std::string& type, const io::mcap::Message& message, const Take& take) {
  if (type != wire::WireType<T>::name) return false;
  T sample;
  if (wire::decode(message.data, message.size, sample)) take(sample);
  return true;
}

}  // namespace

bool LogScore::accepted() const {
  return std::all_of(verdicts.begin(), verdicts.end(), [](const score::Verdict& verdict) { return verdict.passed; });
}

LogScore score_log(const io::McapReader& log, const LogSummary& summary,
                   const std::function<void(const score::ScoredSolution&)>& on_scored) {
  score::Scorer::Options options;
  options.on_scored = on_scored;
  LogScore result{score::Scorer(summary.scenario, options), {}};
  score::Scorer& scorer = result.scorer;
  for (const ProfileInUse& entry : summary.profiles) {
    const auto* installation = std::get_if<InstallationProfile>(&entry.profile);
    if (installation != nullptr) scorer.add(*installation, entry.apply_at_ns);
  }
  log.for_each([&](const io::mcap::Message& message) {
    const std::string& type = log.schemas().at(log.channels().at(message.channel_id).schema_id).name;
    const auto add = [&scorer](const auto& sample) { scorer.add(sample); };
    if (taken<TruthState>(type, message, add) || taken<ImuSample>(type, message, add)) return true;
    if (taken<GnssFix>(type, message, add)) return true;
    taken<NavSolution>(type, message, [&](const NavSolution& solution) {
      scorer.add(solution, static_cast<std::int64_t>(message.log_time_ns));
    });
    return true;
  });
  scorer.finish();
  result.verdicts = score::judge(scorer, summary.scenario.acceptance);
  return result;
}

}  // namespace inslab::cli
