#include "inslab/models/navigation/navigation_filter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/navigation/processes.hpp"

namespace inslab::navigation {

namespace {

constexpr std::int64_t kRounding_ns = 1000;  // times of text files are rounded
constexpr double kKeepEvery_s = 0.02;

/// Splits off the first part of an interval, up to `time_ns`; `interval` becomes the rest.
ImuInterval split_off(ImuInterval& interval, std::int64_t begin_ns, std::int64_t time_ns) {
  const double fraction = time::to_seconds(time_ns - begin_ns) / time::to_seconds(interval.end_ns - begin_ns);
  ImuInterval first = interval;
  first.end_ns = time_ns;
  first.at_rest = first.moves = false;
  first.increments = {fraction * interval.increments.dtheta_b, fraction * interval.increments.dv_b,
                      fraction * interval.increments.dt_s};
  interval.increments.dtheta_b -= first.increments.dtheta_b;
  interval.increments.dv_b -= first.increments.dv_b;
  interval.increments.dt_s -= first.increments.dt_s;
  first.rate_held_over_s = std::max(0.0, interval.rate_held_over_s - interval.increments.dt_s);
  first.force_held_over_s = std::max(0.0, interval.force_held_over_s - interval.increments.dt_s);
  interval.window_begins = false;
  return first;
}

}  // namespace

NavigationFilter::NavigationFilter(const NavigationParameters& parameters, const nav::Gravity& gravity)
    : parameters_(parameters), gravity_(gravity), initializer_(parameters, gravity), rest_(parameters.zero_velocity) {}

void NavigationFilter::start(const nav::NavState& state, std::int64_t time_ns) {
  begin({time_ns, state, {}, StateMatrix(initial_sigmas(parameters_).cwiseAbs2().asDiagonal())}, std::nullopt);
}

void NavigationFilter::begin(const Beginning& beginning, const std::optional<nav::ImuIncrements>& before) {
  filter_.emplace(parameters_, gravity_, beginning.state, beginning.errors, Covariance::of(beginning.covariance),
                  beginning.time_ns, before);
  past_.clear();
  intervals_.clear();
  const auto waits = [&](const Kept& kept) { return kept.valid_at_ns > beginning.time_ns; };
  observations_.erase(observations_.begin(), std::find_if(observations_.begin(), observations_.end(), waits));
}

void NavigationFilter::restart() {
  ++counts_.restarts;
  filter_.reset();
  past_.clear();
  intervals_.clear();
  observations_.clear();
  initializer_ = Initializer(parameters_, gravity_);
  rest_.restart();
}

/// What the IMU said, or what it last said where it said nothing.
ImuInterval NavigationFilter::interval_of(const ImuSample& sample, bool gyro_valid, bool accel_valid) {
  const double dt_s = time::to_seconds(sample.interval_ns);
  ImuInterval interval;
  interval.end_ns = sample.header.sim_time_ns;
  interval.increments.dt_s = dt_s;
  if (gyro_valid) last_rate_b_ = sample.dtheta_b / dt_s;
  if (accel_valid) last_force_b_ = sample.dv_b / dt_s;
  interval.increments.dtheta_b = gyro_valid ? sample.dtheta_b : Vector3(dt_s * last_rate_b_);
  interval.increments.dv_b = accel_valid ? sample.dv_b : Vector3(dt_s * last_force_b_);
  const bool rate_good = gyro_valid && !sample.gyro_saturated, force_good = accel_valid && !sample.accel_saturated;
  rate_held_over_s_ = rate_good ? 0.0 : rate_held_over_s_ + dt_s;
  force_held_over_s_ = force_good ? 0.0 : force_held_over_s_ + dt_s;
  interval.rate_held_over_s = rate_held_over_s_;
  interval.force_held_over_s = force_held_over_s_;
  if (rate_good && force_good) {
    interval.window_begins = rest_.is_new();
    interval.at_rest = parameters_.zero_velocity.use && rest_.add(last_rate_b_, last_force_b_, dt_s);
    interval.moves = !interval.at_rest && rest_.is_new();
  } else {
    ++counts_.imu_not_valid;
    interval.moves = true;
    rest_.restart();
  }
  return interval;
}

std::optional<NavSolution> NavigationFilter::add(const ImuSample& sample) {
  const bool gyro_valid = sample.gyro_valid && sample.dtheta_b.allFinite();
  const bool accel_valid = sample.accel_valid && sample.dv_b.allFinite();
  const std::int64_t begin_ns = sample.header.sim_time_ns - sample.interval_ns;
  if (sample.interval_ns <= 0 || (filter_ && begin_ns < filter_->time_ns() - kRounding_ns)) {
    ++counts_.imu_out_of_order;
    return std::nullopt;
  }
  if (!filter_) {
    if (!gyro_valid || !accel_valid) {
      ++counts_.imu_not_valid;
      return solution(sample);
    }
    if (const auto beginning = initializer_.add(sample)) {
      begin(*beginning, nav::ImuIncrements{sample.dtheta_b, sample.dv_b, time::to_seconds(sample.interval_ns)});
    }
    interval_of(sample, true, true);
    has_measured_ = true;
    return solution(sample);
  }
  try {
    if (begin_ns > filter_->time_ns() + kRounding_ns) bridge(begin_ns);
    if (filter_ && (has_measured_ || (gyro_valid && accel_valid))) {
      has_measured_ = true;
      go_on(interval_of(sample, gyro_valid, accel_valid));
    }
  } catch (const std::domain_error&) {
    restart();
  }
  return solution(sample);
}

/// Missing samples: the last rate and force go on, in steps short enough for the covariance.
void NavigationFilter::bridge(std::int64_t to_ns) {
  ++counts_.imu_gaps;
  rest_.restart();
  if (!has_measured_ || time::to_seconds(to_ns - filter_->time_ns()) > parameters_.coasting.max_gap_s) {
    restart();
    return;
  }
  const auto step_ns = static_cast<std::int64_t>(kKeepEvery_s * 1e9);
  while (filter_->time_ns() < to_ns) {
    ImuInterval interval;
    interval.end_ns = std::min(to_ns, filter_->time_ns() + step_ns);
    const double dt_s = time::to_seconds(interval.end_ns - filter_->time_ns());
    interval.increments = {dt_s * last_rate_b_, dt_s * last_force_b_, dt_s};
    interval.rate_held_over_s = rate_held_over_s_ += dt_s;
    interval.force_held_over_s = force_held_over_s_ += dt_s;
    interval.moves = true;
    go_on(interval);
  }
}

void NavigationFilter::go_on(const ImuInterval& interval) {
  if (parameters_.max_latency_s > 0.0) {
    keep_state();
    intervals_.push_back(interval);
  }
  run(interval);
  forget_old();
}

/// One interval, with the observations that fall into it at their own times.
void NavigationFilter::run(ImuInterval interval) {
  const auto next = [this] {
    return std::find_if(observations_.begin(), observations_.end(),
                        [this](const Kept& kept) { return kept.valid_at_ns > filter_->time_ns(); });
  };
  for (auto kept = next(); kept != observations_.end() && kept->valid_at_ns <= interval.end_ns; ++kept) {
    const std::int64_t time_ns = kept->valid_at_ns;
    if (time_ns > filter_->time_ns() && time_ns < interval.end_ns) {
      filter_->advance(split_off(interval, filter_->time_ns(), time_ns));
    } else if (time_ns == interval.end_ns && filter_->time_ns() < time_ns) {
      filter_->advance(interval);
    }
    take_in(*kept);
  }
  if (filter_->time_ns() < interval.end_ns) filter_->advance(interval);
}

void NavigationFilter::take_in(Kept& kept) {
  UpdateResult result = filter_->update(measurements_of(kept.observation, filter_->situation(), parameters_));
  if (!kept.reported) results_.push_back(std::move(result));
  kept.reported = true;
}

void NavigationFilter::add(const Observation& observation) {
  if (!usable(observation)) {
    ++counts_.fixes_not_used;
    return;
  }
  if (!filter_) {
    if (const auto* fix = std::get_if<GnssFix>(&observation)) initializer_.add(*fix);
    return;
  }
  const std::int64_t time_ns = valid_at_ns(observation);
  if (time::to_seconds(time_ns - filter_->time_ns()) > kMaxAhead_s) {
    ++counts_.fixes_too_early;
    return;
  }
  if (time_ns < filter_->time_ns() && (past_.empty() || time_ns <= past_.front().time_ns())) {
    ++counts_.fixes_too_old;
    return;
  }
  // Of one time they are taken in in the order of their kinds, whichever stream came first.
  const auto after = std::find_if(observations_.begin(), observations_.end(), [&](const Kept& kept) {
    return std::pair(kept.valid_at_ns, kept.observation.index()) > std::pair(time_ns, observation.index());
  });
  const bool overtook = after != observations_.end() && after->valid_at_ns == time_ns;
  const bool can_repeat = !past_.empty() && past_.front().time_ns() < time_ns;
  const auto kept = observations_.insert(after, {observation, time_ns, false});
  try {
    if (time_ns == filter_->time_ns() && !(overtook && can_repeat)) {
      take_in(*kept);
    } else if (time_ns <= filter_->time_ns()) {
      repeat_from(time_ns);
    }
  } catch (const std::domain_error&) {
    restart();
  }
}

/// Back to the newest kept state before the observation, and forward again with all of them.
void NavigationFilter::repeat_from(std::int64_t valid_at_ns) {
  while (past_.back().time_ns() >= valid_at_ns) past_.pop_back();
  filter_ = past_.back();
  for (const ImuInterval& interval : intervals_) {
    if (interval.end_ns <= filter_->time_ns()) continue;
    keep_state();
    run(interval);
  }
}

void NavigationFilter::keep_state() {
  if (past_.empty() || time::to_seconds(filter_->time_ns() - past_.back().time_ns()) >= kKeepEvery_s)
    past_.push_back(*filter_);
}

void NavigationFilter::forget_old() {
  const std::int64_t now_ns = filter_->time_ns();
  while (past_.size() > 1 && time::to_seconds(now_ns - past_[1].time_ns()) >= parameters_.max_latency_s)
    past_.pop_front();
  const std::int64_t oldest_ns = past_.empty() ? now_ns : past_.front().time_ns();
  while (!intervals_.empty() && intervals_.front().end_ns <= oldest_ns) intervals_.pop_front();
  while (!observations_.empty() && observations_.front().valid_at_ns <= oldest_ns) observations_.pop_front();
}

std::vector<UpdateResult> NavigationFilter::take_results() {
  std::vector<UpdateResult> results;
  results.swap(results_);
  return results;
}

NavSolution NavigationFilter::solution(const ImuSample& sample) const {
  NavSolution solution;
  solution.gps_week = sample.header.gps_week;
  solution.gps_time_of_week_ns = sample.header.gps_time_of_week_ns;
  solution.imu_sequence = sample.header.sequence_number;
  solution.reference_point = ReferencePoint::Imu;
  if (!filter_) {
    const bool aligns = parameters_.initial.attitude != InitialAttitude::Given && has_measured_;
    solution.mode = aligns ? NavMode::Aligning : NavMode::Initializing;
    return solution;
  }
  const nav::NavState state = filter_->state();
  const StateVector sigmas = filter_->covariance().matrix().diagonal().cwiseMax(0.0).cwiseSqrt();
  const bool coasts = time::to_seconds(filter_->time_ns() - filter_->last_accepted_ns()) > parameters_.coasting_after_s;
  solution.mode = coasts ? NavMode::Coasting : NavMode::Navigating;
  solution.latitude_rad = state.position.latitude_rad;
  solution.longitude_rad = state.position.longitude_rad;
  solution.height_m = state.position.height_m;
  solution.v_n = state.v_n;
  solution.q_n_body = state.q_nb;
  solution.position_sigma_ned_m = sigmas.segment<3>(kPosition);
  solution.velocity_sigma_ned_m_per_s = sigmas.segment<3>(kVelocity);
  solution.attitude_sigma_rad = sigmas.segment<3>(kAttitude);
  return solution;
}

}  // namespace inslab::navigation
