#include "inslab/referee/verify/navigation_runs.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/matching_barometer.hpp"
#include "inslab/models/navigation/matching_heading.hpp"
#include "inslab/models/navigation/matching_magnetometer.hpp"
#include "inslab/models/navigation/matching_odometer.hpp"
#include "inslab/models/navigation/matching_parameters.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/models/navigation/tag_time.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/noise/random/stream.hpp"
#include "inslab/referee/verify/catalogue.hpp"
#include "inslab/sim/drawn_start.hpp"

namespace inslab::verify {

namespace {

namespace ref = navigation;

constexpr const char* kImuPlace = "installation/imu_trunk";
constexpr const char* kAntennaPlace = "installation/antenna_roof";
constexpr const char* kBarometerPlace = "installation/barometer_dashboard";
constexpr const char* kOdometerPlace = "installation/odometer_rear_left";

/// delta r, delta v, phi of an estimate.
Eigen::Matrix<double, 9, 1> errors_of(const nav::NavState& estimate, const nav::NavState& truth) {
  Eigen::Matrix<double, 9, 1> errors;
  errors << nav::ned_from(truth.position, estimate.position), estimate.v_n - truth.v_n,
      nav::rotation_vector_from_quaternion(truth.q_nb * estimate.q_nb.conjugate());
  return errors;
}

OutageTimes shifted(OutageTimes times, double shift_s) {
  times.first_s += shift_s;
  return times;
}

/// A filter beside one IMU of the run, and its score.
class Scored {
 public:
  Scored(const NavigationSetup& setup, std::size_t imu, std::size_t shift, const ref::NavigationParameters& parameters,
         const nav::Gravity& gravity)
      : imu_index(imu),
        shift_index(shift),
        setup_(setup),
        score_(shifted(setup.outages, setup.shifts_s[shift]), setup.duration_s),
        parameters_(parameters),
        filter_(parameters, gravity),
        draws_(setup.seed, "verify/navigation/" + std::to_string(imu)) {}

  const std::size_t imu_index;
  const std::size_t shift_index;

  void imu(const ImuSample& measured, const ImuTruth& truth) {
    const ImuSample sample = tag_time_.applied(measured);
    if (!begun_) {
      begin(truth);
      return;
    }
    filter_.add(sample);
    // One that has given up and waits for a new beginning stays where it was.
    if (filter_.filter() != nullptr) state_ = filter_.filter()->state();
    score_.add(sample.header.sim_time_ns, state_, nav_state(truth));
    consistency(sample.header.sim_time_ns, nav_state(truth));
  }
  void gnss(GnssFix fix) {
    if (!begun_) return;
    if (!setup_.gnss_velocity) fix.velocity_sigma_ned_m_per_s.setZero();
    filter_.add(tag_time_.applied(ref::Observation(fix)));
    for (const ref::UpdateResult& result : filter_.take_results()) {
      bool rejected = false;
      for (const ref::MeasurementResult& m : result.measurements) {
        if (m.name != ref::GnssPosition::name && m.name != ref::GnssVelocity::name) continue;
        run_.innovations.push_back(m.nis);
        rejected = rejected || !m.accepted;
      }
      if (rejected) ++run_.rejected;
    }
  }
  void aid(const ref::Observation& observation) {
    if (begun_) filter_.add(tag_time_.applied(observation));
  }
  NavigationRun result() const {
    NavigationRun run = run_;
    run.outages = score_.outages();
    return run;
  }

 private:
  /// Truth plus errors drawn from the filter's own initial covariance.
  void begin(const ImuTruth& truth) {
    const Vector9 sigmas = ref::initial_sigmas(parameters_).head<ref::kNavStates>();
    state_ = sim::drawn_start(truth, sigmas, draws_);
    filter_.start(state_, truth.header.sim_time_ns);
    begun_ = true;
  }

  void consistency(std::int64_t time_ns, const nav::NavState& truth) {
    const auto here = [time_ns](double at_s) { return time::from_seconds(at_s).count() == time_ns; };
    if (std::none_of(setup_.nees_at_s.begin(), setup_.nees_at_s.end(), here)) return;
    if (filter_.filter() == nullptr) {
      run_.nees.push_back(std::numeric_limits<double>::infinity());
      return;
    }
    ref::InertialFilter now = *filter_.filter();
    now.settle();
    const Eigen::Matrix<double, 9, 1> e = errors_of(now.state(), truth);
    const Eigen::Matrix<double, 9, 9> P = now.covariance().matrix().topLeftCorner<9, 9>();
    run_.nees.push_back(e.dot(P.llt().solve(e)));
  }

  NavigationSetup setup_;
  OutageScore score_;
  ref::NavigationParameters parameters_;
  ref::NavigationFilter filter_;
  ref::TagTime tag_time_;
  random::Stream draws_;
  bool begun_ = false;
  nav::NavState state_;  ///< of the estimate
  NavigationRun run_;
};

class ScoringSink : public sim::RunSink {
 public:
  std::vector<Scored> filters;

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override {
    for (Scored& filter : filters) {
      if (filter.imu_index == index) filter.imu(sample, truth);
    }
  }
  void gnss(std::size_t index, const GnssFix& fix) override {
    for (Scored& filter : filters) {
      if (filter.shift_index == index) filter.gnss(fix);
    }
  }
  void magnetometer(std::size_t, const MagneticField& sample) override { aid(sample); }
  void barometer(std::size_t, const AirPressure& sample) override { aid(sample); }
  void odometer(std::size_t, const WheelTravel& sample) override { aid(sample); }
  void heading(std::size_t, const BaselineHeading& sample) override { aid(sample); }
  void ack(const ProfileAck&) override {}

 private:
  void aid(const ref::Observation& sample) {
    for (Scored& filter : filters) filter.aid(sample);
  }
};

InstallationProfile heading_place(const TestedHeading& heading) {
  auto place = catalogue_profile<InstallationProfile>(kAntennaPlace);
  place.target = {SensorKind::Heading, 0};
  place.second_lever_arm_v_m = place.lever_arm_v_m + Vector3(heading.baseline_m, 0.0, 0.0);
  return place;
}

/// The other sensors of the setup.
void add_aids(const NavigationSetup& setup, scenario::LoadedScenario& loaded) {
  const time::Rate rate(kAidRate_hz);
  if (setup.magnetometer) {
    scenario::LoadedMagnetometer magnetometer;
    magnetometer.rate = rate;
    magnetometer.errors = *setup.magnetometer;
    magnetometer.installation = catalogue_profile<InstallationProfile>(kImuPlace);
    magnetometer.errors.target = magnetometer.installation.target = {SensorKind::Magnetometer, 0};
    loaded.magnetometers.push_back(magnetometer);
  }
  if (setup.barometer) {
    scenario::LoadedBarometer barometer;
    barometer.rate = rate;
    barometer.errors = setup.barometer->errors;
    barometer.installation = catalogue_profile<InstallationProfile>(kBarometerPlace);
    barometer.errors.target = barometer.installation.target = {SensorKind::Barometer, 0};
    loaded.barometers.push_back(barometer);
  }
  if (setup.odometer) {
    scenario::LoadedOdometer odometer;
    odometer.rate = rate;
    odometer.errors = setup.odometer->errors;
    odometer.installation = catalogue_profile<InstallationProfile>(kOdometerPlace);
    odometer.installation.mounting_rpy_deg += setup.odometer->axis_off_rpy_deg;
    odometer.errors.target = odometer.installation.target = {SensorKind::Odometer, 0};
    loaded.odometers.push_back(odometer);
  }
  if (setup.heading) {
    scenario::LoadedHeading heading;
    heading.rate = rate;
    heading.errors = setup.heading->errors;
    heading.installation = heading_place(*setup.heading);
    heading.errors.target = heading.installation.target;
    loaded.headings.push_back(heading);
  }
}

/// What the filter is told of them.
void match_aids(const NavigationSetup& setup, ref::NavigationParameters& parameters) {
  const auto imu_place = catalogue_profile<InstallationProfile>(kImuPlace);
  if (setup.magnetometer) ref::match(*setup.magnetometer, imu_place, imu_place, parameters);
  if (setup.barometer) {
    const auto place = catalogue_profile<InstallationProfile>(kBarometerPlace);
    ref::match(setup.barometer->believed, place, imu_place, parameters);
  }
  if (setup.heading) ref::match(setup.heading->errors, heading_place(*setup.heading), imu_place, parameters);
  if (!setup.odometer) return;
  parameters.odometer.number = 0;
  ref::match(setup.odometer->errors, catalogue_profile<InstallationProfile>(kOdometerPlace), imu_place, parameters);
  parameters.odometer.axis_sigma_deg = setup.odometer->axis_sigma_deg;
  parameters.rolling_constraint = setup.odometer->constraint;
}

}  // namespace

scenario::LoadedScenario navigation_scenario(const NavigationSetup& setup) {
  scenario::LoadedScenario loaded;
  loaded.scenario.name = "navigation";
  loaded.scenario.start = {scenario::StartAt::GpsTime, 2446, 36000.0};
  loaded.scenario.seed = setup.seed;
  loaded.scenario.duration_s = setup.duration_s;
  loaded.scenario.truth_rate_hz = kImuRate_hz;
  loaded.scenario.trajectory = setup.motion;
  loaded.trajectory_file = setup.file;
  loaded.truth_rate = time::Rate(kImuRate_hz);
  loaded.truth_samples = 1 + static_cast<std::uint64_t>(setup.duration_s * kImuRate_hz);
  for (const TestedImu& tested : setup.imus) {
    scenario::LoadedImu imu;
    imu.number = static_cast<std::uint32_t>(loaded.imus.size());
    imu.rate = loaded.truth_rate;
    imu.errors = tested.errors;
    imu.vibration = tested.vibration;
    imu.installation = catalogue_profile<InstallationProfile>(kImuPlace);
    imu.errors.target = imu.vibration.target = imu.installation.target = {SensorKind::Imu, imu.number};
    loaded.imus.push_back(imu);
  }
  for (const double shift_s : setup.shifts_s) {
    scenario::LoadedGnss gnss;
    gnss.number = static_cast<std::uint32_t>(loaded.gnss.size());
    gnss.rate = time::Rate(setup.gnss_rate_hz);
    gnss.errors = setup.gnss;
    gnss.installation = catalogue_profile<InstallationProfile>(kAntennaPlace);
    gnss.installation.lever_arm_v_m += setup.antenna_off_v_m;
    gnss.errors.target = gnss.installation.target = {SensorKind::Gnss, gnss.number};
    if (setup.outages.first_s < setup.duration_s) {
      const OutageTimes times = shifted(setup.outages, shift_s);
      gnss.outages.push_back({times.first_s, times.length_s, times.spacing_s});
    }
    loaded.gnss.push_back(gnss);
  }
  add_aids(setup, loaded);
  return loaded;
}

ref::NavigationParameters filter_parameters(const NavigationSetup& setup, std::size_t imu) {
  ref::NavigationParameters parameters =
      ref::matching_parameters(setup.imus[imu].believed, catalogue_profile<InstallationProfile>(kImuPlace),
                               catalogue_profile<InstallationProfile>(kAntennaPlace));
  match_aids(setup, parameters);
  parameters.zero_velocity.use = setup.zero_velocity_updates;
  parameters.max_latency_s = 0.0;
  parameters.initial.position_sigma_ned_m = Vector3::Constant(0.05);
  parameters.initial.velocity_sigma_ned_m_per_s = Vector3::Constant(0.05);
  parameters.initial.attitude_sigma_ned_deg = Vector3(0.05, 0.05, 0.5);
  return parameters;
}

std::vector<NavigationRun> navigate(const NavigationSetup& setup, const Subjects& subjects) {
  const scenario::LoadedScenario loaded = navigation_scenario(setup);
  ScoringSink sink;
  for (std::size_t i = 0; i < setup.imus.size(); ++i) {
    for (std::size_t shift = 0; shift < setup.shifts_s.size(); ++shift) {
      sink.filters.emplace_back(setup, i, shift, filter_parameters(setup, i), loaded.gravity_model());
    }
  }
  subjects.simulation(loaded, kNavigationStart, sink);
  std::vector<NavigationRun> runs;
  for (const Scored& filter : sink.filters) runs.push_back(filter.result());
  return runs;
}

}  // namespace inslab::verify
