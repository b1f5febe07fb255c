#pragma once

#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/score/latency.hpp"
#include "inslab/referee/score/mountings.hpp"
#include "inslab/referee/score/outages.hpp"
#include "inslab/referee/score/phases.hpp"
#include "inslab/referee/score/rhythm.hpp"
#include "inslab/referee/score/solution_order.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::score {

/// One scored solution, for pictures.
struct ScoredSolution {
  std::int64_t sim_time_ns;
  bool in_outage;
  const NavSolution& solution;
  const TruePose& truth;
  const SolutionError& error;
};

/// Judges the solutions of one navigation app against the truth, as both come. docs/scoring.md defines every figure.
///
/// Truth, fixes and solutions come in any order among each other, each stream in its own. A solution waits until the
/// truth has gone on by the window, so that fixes and late solutions of its time are there; memory is bounded.
class Scorer {
 public:
  struct Options {
    /// The IMU and the receiver of the app; absent: those of the scenario's reference_nav, or the first.
    std::optional<std::uint32_t> imu_number{};
    std::optional<std::uint32_t> gnss_number{};
    /// Samples of the truth that are kept for late solutions, twice as many as lockstep lets the truth run ahead.
    std::size_t window = 4096;
    /// A solution valid further than this before or after the IMU sample it names is stale, or of the future.
    time::Nanoseconds most_apart{std::chrono::seconds(1)};
    time::Nanoseconds gap{std::chrono::milliseconds(500)};      ///< a longer silence between solutions is a gap
    time::Nanoseconds covers_for{std::chrono::seconds(1)};      ///< a solution answers for this long
    std::size_t most_waiting = 65536;                           ///< solutions
    std::size_t most_swap_intervals = 64;                       ///< later ones count in the last
    std::function<void(const ScoredSolution&)> on_scored = {};  ///< told of each, in order of validity
  };

  explicit Scorer(const scenario::Scenario& scenario) : Scorer(scenario, Options()) {}
  Scorer(const scenario::Scenario& scenario, Options options);

  /// Where a sensor sits after `apply_at_ns`; -1: from the start. Sensors that no solution refers to are passed over.
  void add(const InstallationProfile& installation, std::int64_t apply_at_ns);
  void add(const TruthState& truth);
  /// Fixes of other receivers and samples of other IMUs than the app's are passed over.
  void add(const GnssFix& fix);
  void add(const ImuSample& imu);
  /// `received_realtime_ns`: CLOCK_REALTIME of reception; 0: unknown.
  void add(const NavSolution& solution, std::int64_t received_realtime_ns);
  /// Nothing more comes: judges what waits. Solutions later than the newest truth count as future.
  void finish();

  /// The run has no latency to judge; see Latency::none_because().
  void without_latency(const std::string& why) { latency_.none_because(why); }

  /// No solution that is valid before this sim time will be scored any more; the lowest number before the first truth.
  std::int64_t judged_until_ns() const {
    return truth_.empty() ? std::numeric_limits<std::int64_t>::min() : truth_.front().header.sim_time_ns;
  }

  const SolutionCounts& counts() const { return counts_; }
  const std::map<PhaseKey, ErrorStatistics>& phases() const { return phases_.all(); }
  const std::vector<OutageDrift>& outages() const { return outages_.all(); }
  const Latency& latency() const { return latency_; }
  const Rhythm& rhythm() const { return rhythm_; }

 private:
  struct Received {
    NavSolution solution;
    std::int64_t realtime_ns;
  };

  void resolve(bool all);
  void resolve_interval(const TruthState& before, const TruthState& after);
  void score(const DatedSolution& dated, const TruthState& before, const TruthState& after);
  std::int64_t newest_truth_ns() const { return truth_.back().header.sim_time_ns; }

  Options options_;
  std::optional<std::uint32_t> imu_number_;
  std::optional<std::uint32_t> gnss_number_;

  std::optional<time::GpsTime> start_;  ///< GPS time of sim time 0
  std::deque<TruthState> truth_;        ///< the window; the first is the last one resolved
  std::vector<Received> before_truth_;  ///< came when no truth had
  std::optional<std::int64_t> last_scored_ns_;

  SolutionCounts counts_;
  SolutionOrder order_;
  Mountings mountings_;
  Outages outages_;
  Phases phases_;
  Latency latency_;
  Rhythm rhythm_;
};

}  // namespace inslab::score
