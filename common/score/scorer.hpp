#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "samples/gnss_fix.hpp"
#include "samples/imu_sample.hpp"
#include "samples/installation_profile.hpp"
#include "scenario/scenario.hpp"
#include "score/error_statistics.hpp"
#include "time/gps_time.hpp"

namespace inslab::score {

/// Which solutions an ErrorStatistics is about.
struct PhaseKey {
  scenario::Phase phase = scenario::Phase::All;
  std::uint32_t swap_interval = 0;
  double after_s = 0.0;

  friend bool operator<(const PhaseKey& a, const PhaseKey& b) {
    if (a.after_s != b.after_s) return a.after_s < b.after_s;
    return a.phase != b.phase ? a.phase < b.phase : a.swap_interval < b.swap_interval;
  }
};

/// The largest errors between the last fix before an outage and the first one after it.
struct OutageDrift {
  std::int64_t begin_ns = 0;  ///< sim time of the last fix before it
  std::int64_t end_ns = 0;    ///< of the first fix after it, or of the end of the run
  std::uint64_t solutions = 0;
  double horizontal_m = 0.0;
  double vertical_m = 0.0;
};

/// What was heard of an app besides its errors.
struct SolutionCounts {
  std::uint64_t received = 0;
  std::uint64_t scored = 0;
  std::uint64_t stale = 0;         ///< valid long before the IMU sample it names, or before the truth that is kept
  std::uint64_t future = 0;        ///< valid long after the IMU sample it names, or after the end of the truth
  std::uint64_t non_finite = 0;    ///< not finite, outside the domain, or no rotation
  std::uint64_t duplicates = 0;    ///< as valid as the one before
  std::uint64_t out_of_order = 0;  ///< valid before one that came earlier
  std::uint64_t too_many = 0;      ///< came faster than truth does, and had no room to wait
  std::array<std::uint64_t, EnumNames<NavMode>::values.size()> modes{};
};

/// One scored solution, for pictures.
struct ScoredSolution {
  std::int64_t sim_time_ns;
  bool in_outage;
  const NavSolution& solution;
  const TruePose& truth;
  const SolutionError& error;
};

/// What Scorer::without_latency() is told of a run in lockstep.
inline constexpr const char* kLockstepHasNoLatency = "the run was in lockstep, where the clock waits for the app";

/// Judges the solutions of one navigation app against the truth, as both come. docs/scoring.md defines every figure.
///
/// Truth, fixes and solutions come in any order among each other, each stream in its own. A solution waits until the
/// truth has gone on by the window, so that fixes and late solutions of its time are there; memory is bounded. The
/// journal's installation swaps move the IMU and the antenna.
class Scorer {
 public:
  struct Options {
    /// The IMU and the receiver of the app; absent: the scenario's first.
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
  /// `received_realtime_ns`: CLOCK_REALTIME of reception.
  void add(const NavSolution& solution, std::int64_t received_realtime_ns);
  /// Nothing more comes: judges what waits. Solutions later than the newest truth count as future.
  void finish();

  /// The run has no latency to judge, for this reason ("the run was in lockstep").
  void without_latency(const std::string& why) { why_no_latency_ = why; }

  const SolutionCounts& counts() const { return counts_; }
  const std::map<PhaseKey, ErrorStatistics>& phases() const { return phases_; }
  const std::vector<OutageDrift>& outages() const { return outages_; }
  /// Seconds from an IMU sample's publish time to reception of the solution that names it as its newest.
  const Quantiles& latency_s() const { return latency_s_; }
  const std::string& why_no_latency() const { return why_no_latency_; }     ///< empty: there may be one
  std::uint64_t negative_latencies() const { return negative_latencies_; }  ///< hosts whose clocks do not agree
  std::optional<double> rate_hz() const;
  double longest_gap_s() const { return longest_gap_s_; }
  std::uint64_t gaps() const { return gaps_; }
  std::optional<double> first_solution_s() const { return first_solution_s_; }

 private:
  struct Waiting {
    std::int64_t sim_time_ns;
    NavSolution solution;
  };
  struct FixState {
    std::int64_t sim_time_ns;
    bool has_fix;
  };
  struct Sent {
    std::uint64_t sequence;
    std::int64_t sim_time_ns;
    std::int64_t publish_realtime_ns;
  };
  struct MovedTo {
    std::int64_t apply_at_ns;
    Mounting mounting;
  };

  void note_latency(const Sent& sample, std::int64_t received_realtime_ns);
  const Sent* named_by(const NavSolution& solution) const;
  void note_rhythm(std::int64_t sim_time_ns);
  void resolve(bool all);
  void resolve_interval(const TruthState& before, const TruthState& after);
  void score(const Waiting& waiting, const TruthState& before, const TruthState& after);
  bool can_resolve(std::int64_t sim_time_ns) const;
  bool in_outage(std::int64_t sim_time_ns);
  Mounting mounting_of(ReferencePoint point, std::int64_t sim_time_ns) const;
  template <class Each>
  void for_phases(std::int64_t sim_time_ns, bool outage, std::uint32_t swaps, const Each& each);

  Options options_;
  std::vector<double> after_s_{0.0};  ///< of the acceptance lines
  std::int64_t gnss_period_ns_ = 0;
  std::optional<SensorAddress> imu_;
  std::optional<SensorAddress> gnss_;
  std::vector<MovedTo> imu_mountings_;
  std::vector<MovedTo> antenna_mountings_;

  std::optional<time::GpsTime> start_;  ///< GPS time of sim time 0
  std::deque<TruthState> truth_;        ///< the window; the first is the last one resolved
  std::deque<FixState> fixes_;          ///< from the newest that is not after the time resolved
  std::optional<std::int64_t> last_fix_ns_;
  bool outage_open_ = false;
  std::deque<Sent> sent_;
  std::deque<Waiting> waiting_;                                     ///< by time of validity
  std::vector<std::pair<NavSolution, std::int64_t>> before_truth_;  ///< came when no truth had

  SolutionCounts counts_;
  std::map<PhaseKey, ErrorStatistics> phases_;
  std::vector<OutageDrift> outages_;
  Quantiles latency_s_;
  std::uint64_t negative_latencies_ = 0;
  std::string why_no_latency_;
  std::optional<std::int64_t> last_received_ns_;  ///< validity of the newest in order
  std::optional<std::int64_t> last_scored_ns_;
  std::int64_t first_navigating_ns_ = 0;
  std::int64_t last_navigating_ns_ = 0;
  std::uint64_t navigating_ = 0;
  double longest_gap_s_ = 0.0;
  std::uint64_t gaps_ = 0;
  std::optional<double> first_solution_s_;
};

}  // namespace inslab::score
