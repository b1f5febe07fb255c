#include "inslab/sim/look_ahead.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::sim {

namespace {

constexpr double kG_m_per_s2 = 9.80665;

double seconds(const StreamHeader& header) { return time::to_seconds(header.sim_time_ns); }

class Watcher final : public RunSink {
 public:
  explicit Watcher(const scenario::LoadedScenario& scenario) {
    for (const scenario::LoadedImu& imu : scenario.imus) errors_.push_back(imu.errors);
    over_.resize(scenario.imus.size());
  }

  /// Tries the alignment that has its yaw given beside the one that the scenario's app has, on the app's sensors.
  void try_levelled(const scenario::LoadedScenario& scenario) {
    const scenario::ReferenceNav& app = scenario.scenario.reference_nav.value();
    navigation::AppSetup setup = navigation::setup_for(scenario, app);
    if (setup.parameters.initial.attitude != navigation::InitialAttitude::StaticAlignment) return;
    setup.parameters.initial.attitude = navigation::InitialAttitude::Levelled;
    levelled_.emplace(setup.parameters, setup.gravity);
    app_ = app;
  }

  void journal(const catalog::AnyProfile& entry) override {
    if (const auto* errors = std::get_if<ImuErrorProfile>(&entry)) swaps_.push_back(*errors);
  }

  void truth(const TruthState& truth) override {
    const double t_s = seconds(truth.header);
    if (is_first_) ahead.lowest_m = ahead.highest_m = {truth.height_m, t_s};
    is_first_ = false;
    if (truth.height_m < ahead.lowest_m.value) ahead.lowest_m = {truth.height_m, t_s};
    raise(ahead.highest_m, truth.height_m, t_s);
    raise(ahead.speed_m_per_s, truth.v_n.norm(), t_s);
    raise(ahead.specific_force_m_per_s2, truth.f_v.norm(), t_s);
    raise(ahead.rate_deg_per_s, truth.omega_iv_v.norm() / units::kDeg, t_s);
    ahead.span_s = t_s;
  }

  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override {
    if (levelled_ && !ahead.filter->begins_levelled && sample.sensor_number == app_.imu) {
      levelled_->add(sample);
      ahead.filter->begins_levelled = levelled_->filter() != nullptr;
    }
    if (!sample.gyro_saturated && !sample.accel_saturated) return;
    const double dt_s = time::to_seconds(truth.interval_ns);
    const ImuErrorProfile& errors = in_use(index, sample.header.sim_time_ns);
    if (sample.gyro_saturated) {
      note(index, true, truth.dtheta_b / dt_s / units::kDeg, errors.gyro.full_scale_deg_per_s, sample);
    }
    if (sample.accel_saturated) {
      note(index, false, truth.dv_b / dt_s / kG_m_per_s2, errors.accel.full_scale_g, sample);
    }
  }

  void gnss(std::size_t, const GnssFix& fix) override {
    const bool is_wanted = levelled_ && !ahead.filter->begins_levelled && fix.sensor_number == app_.gnss;
    if (is_wanted) levelled_->add(fix);
  }
  void ack(const ProfileAck&) override {}

  void nav(const NavSolution& solution) override {
    if (!ahead.filter || ahead.filter->begins_s) return;
    if (solution.mode != NavMode::Navigating && solution.mode != NavMode::Coasting) return;
    ahead.filter->begins_s = ahead.span_s;
    ahead.filter->heading_sigma_deg = solution.attitude_sigma_rad.z() / units::kDeg;
    ahead.filter->tilt_sigma_deg = solution.attitude_sigma_rad.head<2>().maxCoeff() / units::kDeg;
  }

  LookAhead take() {
    for (const auto& triads : over_) {
      for (const OverScale& triad : triads) {
        if (triad.samples > 0) ahead.over_scale.push_back(triad);
      }
    }
    return std::move(ahead);
  }

  LookAhead ahead;

 private:
  static void raise(Extreme& most, double value, double at_s) {
    if (value > most.value) most = {value, at_s};
  }

  /// The profile that a sample was made under: the last that was swapped in before.
  const ImuErrorProfile& in_use(std::size_t index, std::int64_t sim_time_ns) const {
    const ImuErrorProfile* newest = &errors_[index];
    for (const ImuErrorProfile& swap : swaps_) {
      if (swap.target.number == errors_[index].target.number && swap.request.apply_at_ns < sim_time_ns) {
        newest = &swap;
      }
    }
    return *newest;
  }

  void note(std::size_t index, bool is_gyro, const Vector3& value, const Vector3& full_scale, const ImuSample& sample) {
    OverScale& triad = over_[index][is_gyro ? 0 : 1];
    if (triad.samples++ == 0) triad.first_s = seconds(sample.header);
    triad.imu = sample.sensor_number;
    triad.is_gyro = is_gyro;
    // The axis that lies furthest beyond its own.
    Eigen::Index axis = 0;
    (full_scale.array() > 0.0).select(value.cwiseAbs().cwiseQuotient(full_scale), 0.0).maxCoeff(&axis);
    if (std::abs(value[axis]) <= triad.largest.value) return;
    triad.axis = static_cast<int>(axis);
    triad.full_scale = full_scale[axis];
    triad.largest = {std::abs(value[axis]), seconds(sample.header)};
  }

  bool is_first_ = true;
  std::vector<ImuErrorProfile> errors_;
  std::vector<ImuErrorProfile> swaps_;
  std::vector<std::array<OverScale, 2>> over_;
  scenario::ReferenceNav app_;
  std::optional<navigation::NavigationFilter> levelled_;
};

std::string why_it_does_not_begin(const navigation::NavigationFilter& filter) {
  const std::string& at_rest = filter.alignment_refusal();
  return "at rest: " + (at_rest.empty() ? "it is too short" : at_rest) + "; in motion: " + filter.motion_refusal();
}

bool has_limit(const ImuErrorProfile& errors) {
  return !errors.gyro.full_scale_deg_per_s.isZero(0.0) || !errors.accel.full_scale_g.isZero(0.0);
}

/// Whether an IMU can put out less than what acts on it, now or after a swap. No other sensor is asked.
template <class Sensor>
bool can_saturate(const scenario::LoadedScenario&, const Sensor&) {
  return false;
}
bool can_saturate(const scenario::LoadedScenario& scenario, const scenario::LoadedImu& imu) {
  return has_limit(imu.errors) ||
         std::any_of(scenario.swaps.begin(), scenario.swaps.end(), [&](const catalog::AnyProfile& swap) {
           const auto* errors = std::get_if<ImuErrorProfile>(&swap);
           return errors != nullptr && errors->target.number == imu.number && has_limit(*errors);
         });
}

/// The sensors that nothing is asked of cost most of the time.
void leave_out_idle_sensors(scenario::LoadedScenario& scenario) {
  for_each(catalog::SensorKinds{}, [&scenario](auto tag) {
    using Kind = typename decltype(tag)::type;
    const auto& app = scenario.scenario.reference_nav;
    const auto is_idle = [&](const scenario::Loaded<Kind>& sensor) {
      const bool is_navigated_by = app && scenario::is_of_the_app<Kind>(*app, sensor.number);
      return !is_navigated_by && !can_saturate(scenario, sensor);
    };
    auto& sensors = scenario.*scenario::LoadedSection<Kind>::sensors;
    sensors.erase(std::remove_if(sensors.begin(), sensors.end(), is_idle), sensors.end());
  });
}

}  // namespace

LookAhead look_ahead(scenario::LoadedScenario scenario, double longest_s,
                     const std::function<void(time::Nanoseconds)>& progress) {
  const bool navigates = !scenario.imus.empty() && !scenario.gnss.empty();
  if (navigates && !scenario.scenario.reference_nav) {
    scenario::ReferenceNav app;
    app.imu = scenario.imus.front().number;
    app.gnss = scenario.gnss.front().number;
    scenario.scenario.reference_nav = app;
  }
  leave_out_idle_sensors(scenario);
  Watcher watcher(scenario);
  if (navigates) {
    watcher.ahead.filter = FilterOutlook{};
    watcher.try_levelled(scenario);
  }
  OfflineRun run(scenario, scenario.start(host::realtime_now()), RunId{}, watcher);
  constexpr int kStepsBetweenLooks = 4096;
  const time::Nanoseconds end = time::from_seconds(longest_s);
  const bool needs_imus = std::any_of(scenario.imus.begin(), scenario.imus.end(),
                                      [&](const scenario::LoadedImu& imu) { return can_saturate(scenario, imu); });
  bool more = true, is_known = false;
  while (more && run.sim_time() < end) {
    for (int i = 0; i < kStepsBetweenLooks && more && run.sim_time() < end; ++i) {
      more = run.step();
      if (is_known || (watcher.ahead.filter && !watcher.ahead.filter->begins_s)) continue;
      is_known = true;
      needs_imus ? run.keep_only<catalog::Imu>() : run.keep_only<>();
    }
    if (progress) progress(run.sim_time());
  }
  LookAhead ahead = watcher.take();
  if (ahead.filter && !ahead.filter->begins_s) {
    ahead.filter->why_not = why_it_does_not_begin(run.navigator()->filter());
  }
  return ahead;
}

std::string text_of(const LookAhead& ahead) {
  std::string text = fmt::format(
      "  motion over {:.3f} s: height {:.1f} m (at {:.2f} s) to {:.1f} m ({:.2f} s), speed up to {:.2f} m/s "
      "({:.2f} s),\n  specific force up to {:.2f} m/s^2 ({:.2f} s), angular rate up to {:.3f} deg/s ({:.2f} s)\n",
      ahead.span_s, ahead.lowest_m.value, ahead.lowest_m.at_s, ahead.highest_m.value, ahead.highest_m.at_s,
      ahead.speed_m_per_s.value, ahead.speed_m_per_s.at_s, ahead.specific_force_m_per_s2.value,
      ahead.specific_force_m_per_s2.at_s, ahead.rate_deg_per_s.value, ahead.rate_deg_per_s.at_s);
  for (const OverScale& over : ahead.over_scale) {
    const char* unit = over.is_gyro ? "deg/s" : "g";
    text += fmt::format(
        "  warning: beyond the full scale of IMU {}'s {}, {:g} {}: {:.4g} {} {} {} at {:.3f} s; the first of {} "
        "samples "
        "at {:.3f} s\n",
        over.imu, over.is_gyro ? "gyros" : "accelerometers", over.full_scale, unit, over.largest.value, unit,
        over.is_gyro ? "about" : "along", "xyz"[over.axis], over.largest.at_s, over.samples, over.first_s);
  }
  if (!ahead.filter) return text;
  if (ahead.filter->begins_s) {
    return text +
           fmt::format("  the reference filter begins at {:.3f} s, heading to {:.2g} deg and tilt to {:.2g} deg\n",
                       *ahead.filter->begins_s, ahead.filter->heading_sigma_deg, ahead.filter->tilt_sigma_deg);
  }
  return text + fmt::format(
                    "  warning: the reference filter does not begin ({}); to begin all the same give "
                    "reference_nav.parameters with initial.attitude {}'given' and all three angles, or let the vehicle "
                    "change its velocity\n",
                    ahead.filter->why_not, ahead.filter->begins_levelled ? "'levelled' and the yaw, or " : "");
}

}  // namespace inslab::sim
