#pragma once

#include <functional>

#include "inslab/referee/evidence/log_summary.hpp"
#include "inslab/referee/score/swap_intervals.hpp"
#include "inslab/referee/score/verdict.hpp"
#include "inslab/referee/score/worst_moment.hpp"

namespace inslab::score {

/// A log scored as the logger scored the run: the same figures from the same samples in the same order.
struct LogScore {
  Scorer scorer;
  std::vector<Verdict> verdicts;
  WorstMoment worst;
  SwapIntervals intervals;

  bool accepted() const;
};

/// Scores a log along a walk.
class LogScorer {
 public:
  using OnScored = std::function<void(const ScoredSolution&)>;

  /// `on_scored` is told of each scored solution, in order of validity. `summary` is used until the end.
  explicit LogScorer(const evidence::LogSummary& summary, OnScored on_scored = {});
  LogScorer(const LogScorer&) = delete;
  LogScorer& operator=(const LogScorer&) = delete;

  void take_part(log::LogWalk& walk);

  /// No solution that is valid before this sim time will be scored any more; the lowest number before the first truth.
  std::int64_t judged_until_ns() const { return scorer_.judged_until_ns(); }

  /// When the walk is over; once.
  LogScore finish();

 private:
  const evidence::LogSummary& summary_;
  OnScored on_scored_;
  WorstMoment worst_;
  Scorer scorer_;
};

/// Reads the log once, for its score alone. Throws files::ReadError.
LogScore score_log(const mcap::McapReader& log, const evidence::LogSummary& summary);

/// An app that works on a log's samples, in place of the one that took part in the run.
struct OfflineApp {
  std::uint32_t imu_number = 0;
  std::uint32_t gnss_number = 0;
  /// Called with every sample of the IMU, in order of time; its solution at the sample's end, if it has one.
  std::function<std::optional<NavSolution>(const ImuSample&)> answer;
};

/// Reads the log once and scores the app's answers. There is no latency and there are no verdicts. Throws
/// files::ReadError, also when the log has no such IMU.
LogScore score_app(const mcap::McapReader& log, const evidence::LogSummary& summary, const OfflineApp& app);

}  // namespace inslab::score
