#pragma once

#include <functional>

#include "inslab/referee/evidence/log_summary.hpp"
#include "inslab/referee/score/acceptance.hpp"
#include "inslab/referee/score/worst_moment.hpp"

namespace inslab::cli {

/// A log scored as the logger scored the run: the same figures from the same samples in the same order.
struct LogScore {
  score::Scorer scorer;
  std::vector<score::Verdict> verdicts;
  WorstMoment worst;

  bool accepted() const;
};

/// Reads the log once. `on_scored` is told of each scored solution. Throws io::ReadError.
LogScore score_log(const io::McapReader& log, const LogSummary& summary,
                   const std::function<void(const score::ScoredSolution&)>& on_scored = {});

/// An app that works on a log's samples, in place of the one that took part in the run.
struct OfflineApp {
  std::uint32_t imu_number = 0;
  std::uint32_t gnss_number = 0;
  /// Called with every sample of the IMU, in order of time; its solution at the sample's end, if it has one.
  std::function<std::optional<NavSolution>(const ImuSample&)> answer;
};

/// Reads the log once and scores the app's answers. There is no latency and there are no verdicts. Throws
/// io::ReadError, also when the log has no such IMU.
LogScore score_app(const io::McapReader& log, const LogSummary& summary, const OfflineApp& app);

}  // namespace inslab::cli
