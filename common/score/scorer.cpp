#include "score/scorer.hpp"

#include <algorithm>
#include <cmath>

#include "nav/attitude.hpp"

namespace inslab::score {

namespace {

constexpr std::size_t kMostSent = 65536;
constexpr std::size_t kMostBeforeTruth = 4096;
constexpr std::size_t kMostOutages = 10000;
constexpr std::int64_t kSilentReceiver_ns = 5'000'000'000;  // truth does not wait longer for a fix
constexpr std::int64_t kMostAhead_ns = 60'000'000'000;      // more than lockstep lets an app hear before the logger
constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

bool names_a_time(const NavSolution& solution) {
  return solution.gps_week <= 10000 && solution.gps_time_of_week_ns >= 0 &&
         solution.gps_time_of_week_ns < std::int64_t{604800} * 1'000'000'000;
}

bool is_navigating(const NavSolution& solution) {
  return solution.mode == NavMode::Navigating || solution.mode == NavMode::Coasting;
}

bool is_sound(const NavSolution& solution) {
  return nav::in_domain({solution.latitude_rad, solution.longitude_rad, solution.height_m}) &&
         std::isfinite(solution.longitude_rad) && solution.v_n.allFinite() &&
         std::abs(solution.q_n_body.norm() - 1.0) < 1e-3;
}

/// The sensor of this number, or the first; null when there is none.
template <class Sensor>
const Sensor* chosen(const std::vector<Sensor>& sensors, const std::optional<std::uint32_t>& number) {
  const auto found = std::find_if(sensors.begin(), sensors.end(),
                                  [&](const Sensor& sensor) { return !number || sensor.number == *number; });
  return found == sensors.end() ? nullptr : &*found;
}

}  // namespace

Scorer::Scorer(const scenario::Scenario& scenario, Options options) : options_(std::move(options)) {
  if (const auto* imu = chosen(scenario.imu, options_.imu_number)) imu_ = SensorAddress{SensorKind::Imu, imu->number};
  if (const auto* gnss = chosen(scenario.gnss, options_.gnss_number)) {
    gnss_ = SensorAddress{SensorKind::Gnss, gnss->number};
    gnss_period_ns_ = std::llround(1e9 / gnss->rate_hz);
  }
  for (const scenario::AcceptanceLimit& line : scenario.acceptance) {
    if (std::find(after_s_.begin(), after_s_.end(), line.after_s) == after_s_.end()) after_s_.push_back(line.after_s);
  }
}

void Scorer::add(const InstallationProfile& installation, std::int64_t apply_at_ns) {
  const Mounting mounting{installation.lever_arm_v_m,
                          nav::quaternion_from_rpy({installation.mounting_rpy_deg.x() * kRadPerDeg,
                                                    installation.mounting_rpy_deg.y() * kRadPerDeg,
                                                    installation.mounting_rpy_deg.z() * kRadPerDeg})};
  if (imu_ && installation.target == *imu_) imu_mountings_.push_back({apply_at_ns, mounting});
  if (gnss_ && installation.target == *gnss_) {
    antenna_mountings_.push_back({apply_at_ns, {mounting.lever_arm_v_m, Quaternion::Identity()}});
  }
}

void Scorer::add(const TruthState& truth) {
  if (!truth_.empty() && truth.header.sim_time_ns <= truth_.back().header.sim_time_ns) return;
  truth_.push_back(truth);
  if (!start_) {
    start_ = time::GpsTime{truth.header.gps_week, truth.header.gps_time_of_week_ns} +
             time::Nanoseconds(-truth.header.sim_time_ns);
    const auto early = std::move(before_truth_);
    before_truth_.clear();
    counts_.received -= early.size();
    for (const auto& [solution, received] : early) add(solution, received);
  }
  resolve(false);
}

void Scorer::add(const GnssFix& fix) {
  if (!gnss_ || fix.sensor_number != gnss_->number) return;
  if (!fixes_.empty() && fix.header.sim_time_ns <= fixes_.back().sim_time_ns) return;
  fixes_.push_back({fix.header.sim_time_ns, fix.fix_type != FixType::None});
}

void Scorer::add(const ImuSample& imu) {
  if (!imu_ || imu.sensor_number != imu_->number) return;
  if (!sent_.empty() && imu.header.sequence_number <= sent_.back().sequence) return;
  sent_.push_back({imu.header.sequence_number, imu.header.sim_time_ns, imu.header.publish_realtime_ns});
  if (sent_.size() > kMostSent) sent_.pop_front();
}

void Scorer::add(const NavSolution& solution, std::int64_t received_realtime_ns) {
  ++counts_.received;
  if (!start_) {
    if (before_truth_.size() < kMostBeforeTruth) {
      before_truth_.emplace_back(solution, received_realtime_ns);
    } else {
      ++counts_.too_many;
    }
    return;
  }
  const auto mode = static_cast<std::size_t>(solution.mode);
  if (mode < counts_.modes.size()) ++counts_.modes[mode];
  const Sent* named = named_by(solution);
  if (named != nullptr) note_latency(*named, received_realtime_ns);
  if (!names_a_time(solution) || (is_navigating(solution) && !is_sound(solution))) {
    ++counts_.non_finite;
    return;
  }
  if (!is_navigating(solution)) return;
  const std::int64_t valid_ns = (time::GpsTime{solution.gps_week, solution.gps_time_of_week_ns} - *start_).count();
  const std::int64_t apart_ns = named == nullptr ? 0 : valid_ns - named->sim_time_ns;
  const bool far_ahead = valid_ns > truth_.back().header.sim_time_ns + kMostAhead_ns;
  if (far_ahead || apart_ns > options_.most_apart.count()) {
    ++counts_.future;
  } else if (apart_ns < -options_.most_apart.count() || valid_ns < truth_.front().header.sim_time_ns) {
    ++counts_.stale;
  } else if (last_received_ns_ && valid_ns <= *last_received_ns_) {
    ++(valid_ns == *last_received_ns_ ? counts_.duplicates : counts_.out_of_order);
  } else {
    note_rhythm(valid_ns);
    if (waiting_.size() < options_.most_waiting) {
      waiting_.push_back({valid_ns, solution});
    } else {
      ++counts_.too_many;
    }
  }
}

void Scorer::finish() {
  resolve(true);
  counts_.future += waiting_.size();
  waiting_.clear();
  if (outage_open_ && !truth_.empty()) outages_.back().end_ns = truth_.back().header.sim_time_ns;
}

std::optional<double> Scorer::rate_hz() const {
  if (navigating_ < 2) return std::nullopt;
  return static_cast<double>(navigating_ - 1) /
         (static_cast<double>(last_navigating_ns_ - first_navigating_ns_) * 1e-9);
}

/// The IMU sample that a solution names; null when it is not there. Apps that do not fill the field in say 0.
const Scorer::Sent* Scorer::named_by(const NavSolution& solution) const {
  if (solution.imu_sequence == 0) return nullptr;
  const auto sent =
      std::lower_bound(sent_.begin(), sent_.end(), solution.imu_sequence,
                       [](const Sent& sample, std::uint64_t sequence) { return sample.sequence < sequence; });
  return sent == sent_.end() || sent->sequence != solution.imu_sequence ? nullptr : &*sent;
}

void Scorer::note_latency(const Sent& sample, std::int64_t received_realtime_ns) {
  if (sample.publish_realtime_ns == 0 || received_realtime_ns == 0) return;
  const std::int64_t latency_ns = received_realtime_ns - sample.publish_realtime_ns;
  if (latency_ns < 0) {
    ++negative_latencies_;
  } else {
    latency_s_.add(static_cast<double>(latency_ns) * 1e-9);
  }
}

void Scorer::note_rhythm(std::int64_t sim_time_ns) {
  if (!last_received_ns_) {
    first_navigating_ns_ = sim_time_ns;
    first_solution_s_ = static_cast<double>(sim_time_ns) * 1e-9;
  } else {
    const std::int64_t silence_ns = sim_time_ns - *last_received_ns_;
    longest_gap_s_ = std::max(longest_gap_s_, static_cast<double>(silence_ns) * 1e-9);
    if (silence_ns > options_.gap.count()) ++gaps_;
  }
  ++navigating_;
  last_received_ns_ = last_navigating_ns_ = sim_time_ns;
}

/// Judges the intervals of the truth for which everything is there.
void Scorer::resolve(bool all) {
  while (truth_.size() >= 2 &&
         (all || (truth_.size() > options_.window && can_resolve(truth_[1].header.sim_time_ns)))) {
    resolve_interval(truth_[0], truth_[1]);
    truth_.pop_front();
  }
}

/// Whether the fixes have come that far, or have been silent for long.
bool Scorer::can_resolve(std::int64_t sim_time_ns) const {
  return !gnss_ || (!fixes_.empty() && fixes_.back().sim_time_ns >= sim_time_ns) ||
         truth_.back().header.sim_time_ns - sim_time_ns > std::max(kSilentReceiver_ns, 3 * gnss_period_ns_);
}

void Scorer::resolve_interval(const TruthState& before, const TruthState& after) {
  const std::int64_t end_ns = after.header.sim_time_ns;
  while (!waiting_.empty() && waiting_.front().sim_time_ns <= end_ns) {
    score(waiting_.front(), before, after);
    waiting_.pop_front();
  }
  const bool covered = last_scored_ns_ && end_ns - *last_scored_ns_ <= options_.covers_for.count();
  const double length_s = static_cast<double>(end_ns - before.header.sim_time_ns) * 1e-9;
  for_phases(end_ns, in_outage(end_ns), after.journal_in_effect,
             [&](ErrorStatistics& statistics) { statistics.add_time(length_s, covered); });
}

void Scorer::score(const Waiting& waiting, const TruthState& before, const TruthState& after) {
  const std::int64_t valid_ns = waiting.sim_time_ns;
  const TruePose truth =
      true_pose(truth_between(before, after, valid_ns), mounting_of(waiting.solution.reference_point, valid_ns));
  const SolutionError error = error_of(waiting.solution, truth);
  const bool outage = in_outage(valid_ns);
  ++counts_.scored;
  last_scored_ns_ = valid_ns;
  for_phases(valid_ns, outage, after.journal_in_effect,
             [&](ErrorStatistics& statistics) { statistics.add(error, waiting.solution); });
  if (outage && outage_open_) {
    OutageDrift& drift = outages_.back();
    ++drift.solutions;
    drift.horizontal_m = std::max(drift.horizontal_m, error.position_ned_m.head<2>().norm());
    drift.vertical_m = std::max(drift.vertical_m, std::abs(error.position_ned_m.z()));
  }
  if (options_.on_scored) options_.on_scored({valid_ns, outage, waiting.solution, truth, error});
}

/// Whether a time lies between a fix and the next one, with an epoch without a fix between them. Times do not go back.
bool Scorer::in_outage(std::int64_t sim_time_ns) {
  while (!fixes_.empty() && fixes_.front().sim_time_ns <= sim_time_ns) {
    if (fixes_.front().has_fix) {
      last_fix_ns_ = fixes_.front().sim_time_ns;
      if (outage_open_) outages_.back().end_ns = *last_fix_ns_;
      outage_open_ = false;
    }
    fixes_.pop_front();
  }
  if (outage_open_ || !last_fix_ns_ || *last_fix_ns_ == sim_time_ns) return outage_open_;
  const std::int64_t next_ns = fixes_.empty() ? truth_.back().header.sim_time_ns : fixes_.front().sim_time_ns;
  const bool epoch_missing = 2 * (next_ns - *last_fix_ns_) > 3 * gnss_period_ns_;
  const bool next_is_none = !fixes_.empty() && !fixes_.front().has_fix;
  if ((epoch_missing || next_is_none) && outages_.size() < kMostOutages) {
    outage_open_ = true;
    outages_.push_back({*last_fix_ns_, next_ns, 0, 0.0, 0.0});
  }
  return outage_open_;
}

Mounting Scorer::mounting_of(ReferencePoint point, std::int64_t sim_time_ns) const {
  if (point == ReferencePoint::Vehicle) return {};
  const std::vector<MovedTo>& mountings = point == ReferencePoint::Imu ? imu_mountings_ : antenna_mountings_;
  const MovedTo* latest = nullptr;
  for (const MovedTo& candidate : mountings) {
    if (candidate.apply_at_ns >= sim_time_ns && candidate.apply_at_ns >= 0) continue;
    if (latest == nullptr || candidate.apply_at_ns >= latest->apply_at_ns) latest = &candidate;
  }
  return latest == nullptr ? Mounting{} : latest->mounting;
}

template <class Each>
void Scorer::for_phases(std::int64_t sim_time_ns, bool outage, std::uint32_t swaps, const Each& each) {
  const auto most = static_cast<std::uint32_t>(options_.most_swap_intervals);
  for (const double after_s : after_s_) {
    if (static_cast<double>(sim_time_ns) * 1e-9 < after_s) continue;
    each(phases_[{scenario::Phase::All, 0, after_s}]);
    each(phases_[{outage ? scenario::Phase::Outages : scenario::Phase::BetweenOutages, 0, after_s}]);
    each(phases_[{scenario::Phase::SwapInterval, std::min(swaps, most), after_s}]);
  }
}

}  // namespace inslab::score
