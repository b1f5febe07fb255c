#include "inslab/referee/report/report_expectation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::report {

namespace {

Vector3 reported_or_made(const Vector3& sigma, const Vector3& error) {
  Vector3 size = error.cwiseAbs();
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(sigma[axis]) && sigma[axis] > 0.0) size[axis] = sigma[axis];
  }
  return size;
}

nav::Gravity gravity_of(const scenario::Scenario& scenario) {
  scenario::LoadedScenario loaded;
  loaded.scenario = scenario;
  if (!scenario.trajectory.gravity.grid_file.empty()) {
    // A log does not hold what the file said. That gravity departs from its model does count.
    const nav::GravityGrid::Axis axis{0.0, 1.0, 3};
    loaded.gravity_grid =
        std::make_shared<nav::GravityGrid>(axis, axis, std::vector<nav::Vector3>(9, nav::Vector3::Zero()));
  }
  return loaded.gravity();
}

/// Of a grid nothing is known here, so that it is named as left out.
std::optional<predict::GravityErrors> gravity_errors_of(const scenario::Scenario& scenario) {
  const scenario::GravityOptions& options = scenario.trajectory.gravity;
  const auto along_way = scenario::gravity_along_way(options, nullptr);
  if (!along_way || !options.grid_file.empty()) return std::nullopt;
  return predict::GravityErrors{*along_way, true};  // an app that levels itself leans with the plumb line
}

bool has_topic(const mcap::McapReader& log, const std::string& topic, std::string_view type) {
  return !log::channels_of(log, topic, type).empty();
}

bool is_before(double time_s, const predict::PredictedError& error) { return time_s < error.time_s; }

predict::PredictedError beginning_of(const score::ScoredSolution& first) {
  const NavSolution& solution = first.solution;
  return {time::to_seconds(first.sim_time_ns),
          reported_or_made(solution.position_sigma_ned_m, first.error.position_ned_m),
          reported_or_made(solution.velocity_sigma_ned_m_per_s, first.error.velocity_ned_m_per_s),
          reported_or_made(solution.attitude_sigma_rad, first.error.phi_rad)};
}

}  // namespace

const predict::PredictedError* Expectation::at(double time_s) const {
  const auto next = std::upper_bound(curve.begin(), curve.end(), time_s, is_before);
  return next == curve.begin() ? nullptr : &*(next - 1);
}

const predict::PredictedError* Expectation::before(double time_s) const {
  const auto next = std::lower_bound(curve.begin(), curve.end(), time_s,
                                     [](const predict::PredictedError& error, double t) { return error.time_s < t; });
  return next == curve.begin() ? nullptr : &*(next - 1);
}

std::optional<std::uint32_t> receiver_of_app(const scenario::Scenario& scenario) {
  if (scenario.gnss.empty()) return std::nullopt;
  return scenario.reference_nav ? scenario.reference_nav->gnss : scenario.gnss.front().number;
}

ExpectationOfLog::ExpectationOfLog(const mcap::McapReader& log, const evidence::LogSummary& summary,
                                   std::vector<GnssFix> fixes)
    : fixes_(std::move(fixes)) {
  const scenario::Scenario& scenario = summary.scenario;
  if (scenario.imu.empty()) {
    expectation_.missing = "the scenario has no IMU";
    return;
  }
  setup_.gravity = gravity_of(scenario);
  setup_.gravity_errors = gravity_errors_of(scenario);
  setup_.imu_number = scenario.reference_nav ? scenario.reference_nav->imu : scenario.imu.front().number;
  setup_.gnss_number = receiver_of_app(scenario);
  expectation_.of = setup_.gnss_number ? fmt::format("the best filter of the fixes of gnss {}", *setup_.gnss_number)
                                       : std::string("free inertial navigation");
  const std::string topic = catalog::stream_topic<ImuTruth>(setup_.imu_number);
  if (!has_topic(log, topic, catalog::WireType<ImuTruth>::name)) expectation_.missing = "the log has no " + topic;
  for (const evidence::ProfileInUse& entry : summary.profiles) {
    profiles_.push_back(entry.profile);
    catalog::request_of(profiles_.back()).apply_at_ns = entry.apply_at_ns;
  }
  std::stable_sort(fixes_.begin(), fixes_.end(),
                   [](const GnssFix& a, const GnssFix& b) { return a.header.sim_time_ns < b.header.sim_time_ns; });
}

void ExpectationOfLog::take_part(log::LogWalk& walk, std::function<std::int64_t()> judged_until_ns) {
  if (!expectation_.missing.empty()) return;
  judged_until_ns_ = std::move(judged_until_ns);
  walk.each<ImuTruth>([this, topic = catalog::stream_topic<ImuTruth>(setup_.imu_number)](
                          const ImuTruth& truth, const log::LogWalk::Place& place) {
    if (place.topic == topic) add(truth);
  });
}

void ExpectationOfLog::add(const score::ScoredSolution& scored) {
  if (begun_) return;
  begun_ = true;
  if (!expectation_.missing.empty()) return;
  setup_.start = beginning_of(scored);
  errors_.emplace(setup_, std::move(profiles_));
  for (const ImuTruth& truth : waiting_) follow(truth);
  waiting_.clear();
}

void ExpectationOfLog::add(const ImuTruth& truth) {
  if (errors_) return follow(truth);
  waiting_.push_back(truth);
  // What lies before every solution that may still be the first is before its beginning.
  const std::int64_t judged_until_ns = judged_until_ns_();
  while (!waiting_.empty() && waiting_.front().header.sim_time_ns < judged_until_ns) waiting_.pop_front();
}

void ExpectationOfLog::follow(const ImuTruth& truth) {
  for (; next_fix_ < fixes_.size() && fixes_[next_fix_].header.sim_time_ns < truth.header.sim_time_ns; ++next_fix_) {
    errors_->add(fixes_[next_fix_]);
  }
  errors_->add(truth);
}

Expectation ExpectationOfLog::finish() {
  if (!begun_) {
    expectation_ = {};
    expectation_.missing = "no solution was scored";
  }
  if (!errors_) return std::move(expectation_);
  expectation_.curve = errors_->curve();
  expectation_.left_out = errors_->left_out();
  if (expectation_.curve.empty()) {
    expectation_.missing =
        "the log has no " + catalog::stream_topic<ImuTruth>(setup_.imu_number) + " after the first solution";
  }
  return std::move(expectation_);
}

}  // namespace inslab::report
