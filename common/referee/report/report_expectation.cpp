#include "inslab/referee/report/report_expectation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::cli {

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
  return loaded.gravity();
}

bool has_topic(const io::McapReader& log, const std::string& topic, std::string_view type) {
  return !io::channels_of(log, topic, type).empty();
}

std::vector<GnssFix> fixes_of(const io::McapReader& log, std::uint32_t number) {
  std::vector<GnssFix> fixes;
  const std::string topic = catalog::stream_topic<GnssFix>(number);
  if (!has_topic(log, topic, wire::WireType<GnssFix>::name)) return fixes;
  io::for_each_sample<GnssFix>(log, topic, [&](const GnssFix& fix, std::uint64_t) {
    fixes.push_back(fix);
    return true;
  });
  std::stable_sort(fixes.begin(), fixes.end(),
                   [](const GnssFix& a, const GnssFix& b) { return a.header.sim_time_ns < b.header.sim_time_ns; });
  return fixes;
}

bool is_before(double time_s, const predict::PredictedError& error) { return time_s < error.time_s; }

}  // namespace

predict::PredictedError beginning_of(const score::ScoredSolution& first) {
  const NavSolution& solution = first.solution;
  return {static_cast<double>(first.sim_time_ns) * 1e-9,
          reported_or_made(solution.position_sigma_ned_m, first.error.position_ned_m),
          reported_or_made(solution.velocity_sigma_ned_m_per_s, first.error.velocity_ned_m_per_s),
          reported_or_made(solution.attitude_sigma_rad, first.error.phi_rad)};
}

const predict::PredictedError* Expectation::at(double time_s) const {
  const auto next = std::upper_bound(curve.begin(), curve.end(), time_s, is_before);
  return next == curve.begin() ? nullptr : &*(next - 1);
}

const predict::PredictedError* Expectation::before(double time_s) const {
  const auto next = std::lower_bound(curve.begin(), curve.end(), time_s,
                                     [](const predict::PredictedError& error, double t) { return error.time_s < t; });
  return next == curve.begin() ? nullptr : &*(next - 1);
}

Expectation expectation_of(const io::McapReader& log, const LogSummary& summary, const predict::PredictedError& start) {
  Expectation expectation;
  const scenario::Scenario& scenario = summary.scenario;
  if (scenario.imu.empty()) {
    expectation.missing = "the scenario has no IMU";
    return expectation;
  }
  predict::ExpectedErrors::Setup setup;
  setup.gravity = gravity_of(scenario);
  const auto& app = scenario.reference_nav;
  setup.imu_number = app ? app->imu : scenario.imu.front().number;
  setup.start = start;
  if (!scenario.gnss.empty()) setup.gnss_number = app ? app->gnss : scenario.gnss.front().number;
  expectation.of = setup.gnss_number ? fmt::format("the best filter of the fixes of gnss {}", *setup.gnss_number)
                                     : std::string("free inertial navigation");
  const std::string topic = catalog::stream_topic<ImuTruth>(setup.imu_number);
  if (!has_topic(log, topic, wire::WireType<ImuTruth>::name)) {
    expectation.missing = "the log has no " + topic;
    return expectation;
  }
  std::vector<AnyProfile> profiles;
  for (const ProfileInUse& entry : summary.profiles) {
    profiles.push_back(entry.profile);
    request_of(profiles.back()).apply_at_ns = entry.apply_at_ns;
  }
  predict::ExpectedErrors errors(setup, profiles);
  const std::vector<GnssFix> fixes = setup.gnss_number ? fixes_of(log, *setup.gnss_number) : std::vector<GnssFix>{};
  auto fix = fixes.begin();
  io::for_each_sample<ImuTruth>(log, topic, [&](const ImuTruth& truth, std::uint64_t) {
    for (; fix != fixes.end() && fix->header.sim_time_ns < truth.header.sim_time_ns; ++fix) errors.add(*fix);
    errors.add(truth);
    return true;
  });
  expectation.curve = errors.curve();
  expectation.left_out = errors.left_out();
  if (expectation.curve.empty()) expectation.missing = "the log has no " + topic + " after the first solution";
  return expectation;
}

}  // namespace inslab::cli
