#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/models/navigation/inertial_filter.hpp"
#include "inslab/models/navigation/initializer.hpp"
#include "inslab/models/navigation/measurements.hpp"
#include "inslab/models/navigation/rest_detector.hpp"

namespace inslab::navigation {

/// The navigation app as a pure model: IMU samples and observations of any kind in measurements.hpp, such as fixes, in,
/// a solution for every IMU sample out.
///
/// Samples come in the order in which an app gets them. An observation that is valid in the past is taken in at its own
/// time: the filter goes back to a kept state before it and repeats what followed, IMU intervals and observations, so
/// the answer is, to the bit, that of one without latency. One between two IMU samples splits the interval, its
/// increments in proportion. One valid in the future waits. Sim time is read from the headers; nothing else of them is
/// used.
///
/// IMU samples that are not valid (flag, or a number that is none) are bridged with the last valid rate or force and a
/// covariance to match, missing ones likewise up to coasting.max_gap_s; after a longer gap, or when the solution leaves
/// the valid domain, the filter begins anew with the next fix.
class NavigationFilter {
 public:
  /// How much was not used, and why; a fix here is an observation of any kind.
  struct Counts {
    std::uint64_t imu_out_of_order = 0;  ///< not after the one before, or without an interval
    std::uint64_t imu_not_valid = 0;     ///< held over, in whole or in part
    std::uint64_t imu_gaps = 0;
    std::uint64_t fixes_not_used = 0;   ///< no solution, not finite, without a sigma
    std::uint64_t fixes_too_old = 0;    ///< beyond max_latency_s, or before the filter began
    std::uint64_t fixes_too_early = 0;  ///< more than kMaxAhead_s in the future
    std::uint64_t restarts = 0;
  };
  static constexpr double kMaxAhead_s = 10.0;

  NavigationFilter(const NavigationParameters& parameters, const nav::Gravity& gravity);

  /// Begins at a known state instead; sigmas are the parameters'. Throws as nav::Strapdown does.
  void start(const nav::NavState& state, std::int64_t time_ns);

  /// The solution of the IMU at the sample's end; nothing when the sample is out of order. Before the filter has begun
  /// the mode is initializing or aligning and the rest is 0.
  std::optional<NavSolution> add(const ImuSample& sample);

  /// A fix, or any other sample that measurements are made of. Before the filter has begun, fixes alone are used.
  void add(const Observation& observation);

  /// What became of the observations since the last call, in the order in which they were taken in, each once.
  std::vector<UpdateResult> take_results();

  const Counts& counts() const { return counts_; }
  const std::string& alignment_refusal() const { return initializer_.refusal(); }
  /// Why it could not begin in motion either; changes as the vehicle moves.
  const std::string& motion_refusal() const { return initializer_.motion_refusal(); }
  /// Null until the filter has begun.
  const InertialFilter* filter() const { return filter_ ? &*filter_ : nullptr; }

 private:
  struct Kept {
    Observation observation;
    std::int64_t valid_at_ns = 0;
    bool reported = false;
  };

  ImuInterval interval_of(const ImuSample& sample, bool gyro_valid, bool accel_valid);
  void bridge(std::int64_t to_ns);
  void go_on(const ImuInterval& interval);
  void run(ImuInterval interval);
  void take_in(Kept& kept);
  void repeat_from(std::int64_t valid_at_ns);
  void keep_state();
  void forget_old();
  void begin(const Beginning& beginning, const std::optional<nav::ImuIncrements>& before);
  void restart();
  NavSolution solution(const ImuSample& sample) const;

  NavigationParameters parameters_;
  nav::Gravity gravity_;
  Initializer initializer_;
  RestDetector rest_;
  std::optional<InertialFilter> filter_;
  std::deque<InertialFilter> past_;    ///< in order of time, each with every observation up to its own time
  std::deque<ImuInterval> intervals_;  ///< since the oldest of `past_`
  std::deque<Kept> observations_;      ///< in order of time: since the oldest of `past_`, and those that wait
  std::vector<UpdateResult> results_;
  Counts counts_;
  Vector3 last_rate_b_ = Vector3::Zero();   ///< as measured, rad/s
  Vector3 last_force_b_ = Vector3::Zero();  ///< as measured, m/s^2
  double rate_held_over_s_ = 0.0;
  double force_held_over_s_ = 0.0;
  bool has_measured_ = false;
};

}  // namespace inslab::navigation
