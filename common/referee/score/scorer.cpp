#include "inslab/referee/score/scorer.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::score {

namespace {

constexpr std::size_t kMostBeforeTruth = 4096;
constexpr std::int64_t kMostAhead_ns = 60'000'000'000;  // more than lockstep lets an app hear before the logger

bool names_a_time(const NavSolution& solution) {
  return solution.gps_week <= time::kLastGpsWeek && solution.gps_time_of_week_ns >= 0 &&
         solution.gps_time_of_week_ns < std::int64_t{604800} * 1'000'000'000;
}

bool is_navigating(const NavSolution& solution) {
  return solution.mode == NavMode::Navigating || solution.mode == NavMode::Coasting;
}

bool is_sound(const NavSolution& solution) {
  return nav::in_domain(geodetic_of(solution)) && std::isfinite(solution.longitude_rad) && solution.v_n.allFinite() &&
         std::abs(solution.q_n_body.norm() - 1.0) < 1e-3;
}

/// The sensor of this number, or the first; null when there is none.
template <class Sensor>
const Sensor* chosen(const std::vector<Sensor>& sensors, const std::optional<std::uint32_t>& number) {
  const auto found = std::find_if(sensors.begin(), sensors.end(),
                                  [&](const Sensor& sensor) { return !number || sensor.number == *number; });
  return found == sensors.end() ? nullptr : &*found;
}

/// What was chosen, else what the scenario's own app uses, else the first.
Scorer::Options completed(Scorer::Options options, const scenario::Scenario& scenario) {
  if (!scenario.reference_nav) return options;
  if (!options.imu_number) options.imu_number = scenario.reference_nav->imu;
  if (!options.gnss_number) options.gnss_number = scenario.reference_nav->gnss;
  return options;
}

template <class Sensor>
std::optional<std::uint32_t> number_of(const Sensor* sensor) {
  return sensor == nullptr ? std::nullopt : std::optional(sensor->number);
}

std::int64_t period_ns(const scenario::GnssSensor* receiver) {
  return receiver == nullptr ? 0 : std::llround(1e9 / receiver->rate_hz);
}

}  // namespace

Scorer::Scorer(const scenario::Scenario& scenario, Options options)
    : options_(completed(std::move(options), scenario)),
      imu_number_(number_of(chosen(scenario.imu, options_.imu_number))),
      gnss_number_(number_of(chosen(scenario.gnss, options_.gnss_number))),
      order_(options_.most_waiting, options_.most_apart.count()),
      mountings_(imu_number_, gnss_number_),
      outages_(period_ns(chosen(scenario.gnss, options_.gnss_number))),
      phases_(scenario.acceptance, options_.most_swap_intervals),
      rhythm_(options_.gap.count()) {}

void Scorer::add(const InstallationProfile& installation, std::int64_t apply_at_ns) {
  mountings_.add(installation, apply_at_ns);
}

void Scorer::add(const TruthState& truth) {
  if (!truth_.empty() && truth.header.sim_time_ns <= newest_truth_ns()) return;
  truth_.push_back(truth);
  if (!start_) {
    start_ = time::GpsTime{truth.header.gps_week, truth.header.gps_time_of_week_ns} +
             time::Nanoseconds(-truth.header.sim_time_ns);
    const auto early = std::move(before_truth_);
    before_truth_.clear();
    counts_.received -= early.size();
    for (const auto& [solution, realtime_ns] : early) add(solution, realtime_ns);
  }
  resolve(false);
}

void Scorer::add(const GnssFix& fix) {
  if (gnss_number_ == fix.sensor_number) outages_.add(fix.header.sim_time_ns, fix.fix_type != FixType::None);
}

void Scorer::add(const ImuSample& imu) {
  if (imu_number_ == imu.sensor_number) latency_.add(imu);
}

void Scorer::add(const NavSolution& solution, std::int64_t received_realtime_ns) {
  ++counts_.received;
  if (!start_) {
    if (before_truth_.size() < kMostBeforeTruth) {
      before_truth_.push_back({solution, received_realtime_ns});
    } else {
      ++counts_.too_many;
    }
    return;
  }
  const auto mode = static_cast<std::size_t>(solution.mode);
  if (mode < counts_.modes.size()) ++counts_.modes[mode];
  const Latency::Sent* named = latency_.named_by(solution);
  if (named != nullptr) latency_.note(*named, received_realtime_ns);
  if (!names_a_time(solution) || (is_navigating(solution) && !is_sound(solution))) {
    ++counts_.non_finite;
    return;
  }
  if (!is_navigating(solution)) return;
  const std::int64_t valid_ns = (time::GpsTime{solution.gps_week, solution.gps_time_of_week_ns} - *start_).count();
  const std::int64_t apart_ns = named == nullptr ? 0 : valid_ns - named->sim_time_ns;
  if (valid_ns > newest_truth_ns() + kMostAhead_ns || apart_ns > options_.most_apart.count()) {
    ++counts_.future;
  } else if (apart_ns < -options_.most_apart.count() || valid_ns < truth_.front().header.sim_time_ns) {
    ++counts_.stale;
  } else {
    order_.add({valid_ns, solution}, newest_truth_ns(), counts_);
  }
}

void Scorer::finish() {
  resolve(true);
  order_.finish(counts_);
  if (truth_.empty()) return;
  outages_.finish(newest_truth_ns());
  rhythm_.finish(newest_truth_ns());
}

/// Judges the intervals of the truth for which everything is there.
void Scorer::resolve(bool all) {
  while (truth_.size() >= 2 && (all || (truth_.size() > options_.window &&
                                        outages_.can_tell(truth_[1].header.sim_time_ns, newest_truth_ns())))) {
    resolve_interval(truth_[0], truth_[1]);
    truth_.pop_front();
  }
}

void Scorer::resolve_interval(const TruthState& before, const TruthState& after) {
  const std::int64_t end_ns = after.header.sim_time_ns;
  while (const auto dated = order_.take(end_ns)) score(*dated, before, after);
  const bool covered = last_scored_ns_ && end_ns - *last_scored_ns_ <= options_.covers_for.count();
  const double length_s = time::to_seconds(end_ns - before.header.sim_time_ns);
  phases_.add_time({end_ns, outages_.contains(end_ns, newest_truth_ns()), after.journal_in_effect}, length_s, covered);
}

void Scorer::score(const DatedSolution& dated, const TruthState& before, const TruthState& after) {
  const auto& [valid_ns, solution] = dated;
  const TruePose truth =
      true_pose(truth_between(before, after, valid_ns), mountings_.at(solution.reference_point, valid_ns));
  const SolutionError error = error_of(solution, truth);
  const bool in_outage = outages_.contains(valid_ns, newest_truth_ns());
  ++counts_.scored;
  last_scored_ns_ = valid_ns;
  rhythm_.note(valid_ns);
  outages_.note(error);
  phases_.add({valid_ns, in_outage, after.journal_in_effect}, error, solution);
  if (options_.on_scored) options_.on_scored({valid_ns, in_outage, solution, truth, error});
}

}  // namespace inslab::score
