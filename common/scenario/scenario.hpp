#pragma once

#include <optional>
#include <tuple>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/outage.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/acceptance.hpp"
#include "inslab/scenario/aiding_sensors.hpp"
#include "inslab/scenario/trajectory.hpp"

/// What a scenario file says. Paths in it are relative to the file; scenario/load.hpp follows them.
namespace inslab::scenario {

enum class StartAt : std::uint32_t { GpsTime, Now };

/// GPS time of sim time 0.
struct Start {
  static constexpr bool has_discriminator = true;

  StartAt at = StartAt::GpsTime;
  std::uint32_t gps_week = 2399;
  double gps_seconds_of_week_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit);
};

/// One IMU of the unit. Profiles are files; without one the IMU is ideal, still, and at the reference point.
struct ImuSensor {
  std::uint32_t number = 0;
  double rate_hz = 200.0;
  std::string error_profile;
  std::string vibration_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/imu/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its samples").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file; absent: an ideal IMU").at_most(4096), self.error_profile);
    visit(Field("vibration_profile", "file; absent: still").at_most(4096), self.vibration_profile);
    visit(Field("installation_profile", "file; absent: at the vehicle's reference point").at_most(4096),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
  }
};

/// One GNSS receiver of the unit.
struct GnssSensor {
  std::uint32_t number = 0;
  double rate_hz = 5.0;
  std::string error_profile;
  std::string installation_profile;
  std::string nominal_installation_profile;
  std::vector<Outage> outages;
  std::vector<OutageArea> outage_areas;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("number", "the N of inslab/gnss/N").in(0.0, 63.0), self.number);
    visit(Field("rate_hz", "of its epochs").in(1e-3, 1e4).required(), self.rate_hz);
    visit(Field("error_profile", "file").at_most(4096).required(), self.error_profile);
    visit(Field("installation_profile", "file; absent: at the vehicle's reference point").at_most(4096),
          self.installation_profile);
    visit(Field("nominal_installation_profile", "file: what the app is told; absent: the true one").at_most(4096),
          self.nominal_installation_profile);
    visit(Field("outages", "no signals in these").at_most(10000), self.outages);
    visit(Field("outage_areas", "no signals while the antenna is in these").at_most(1000), self.outage_areas);
  }
};

/// A profile that is swapped in while the run goes on.
struct ScheduledSwap {
  double at_s = 0.0;
  ProfileKind kind = ProfileKind::ImuError;
  SensorKind sensor_kind = SensorKind::Imu;
  std::uint32_t sensor_number = 0;
  std::string profile;
  Continuity continuity = Continuity::Keep;
  double fade_s = 0.0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(
        Field("at_s", "sim time; the first sample after it is the first under the new profile").in(0.0, 1e7).required(),
        self.at_s);
    visit(Field("kind").required(), self.kind);
    visit(Field("sensor_kind").required(), self.sensor_kind);
    visit(Field("sensor_number").in(0.0, 63.0), self.sensor_number);
    visit(Field("profile", "file").at_most(4096).required(), self.profile);
    visit(Field("continuity", "what happens to the states of the random processes"), self.continuity);
    visit(Field("fade_s", "vibration only: length of the smooth fade").in(0.0, 60.0), self.fade_s);
  }
};

/// A schedule file: swaps for a set that runs.
struct Schedule {
  std::vector<ScheduledSwap> swaps;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("swaps", "in order of time").at_most(10000).required(), self.swaps);
  }
};

/// What sets the pace of a live run.
struct Clock {
  ClockMode mode = ClockMode::RealTime;
  double rate = 1.0;
  bool start_paused = false;
  double max_lag_ms = 20.0;
  double ready_timeout_s = 30.0;
  bool whole_second_start = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("mode", "real_time: absolute deadlines; lockstep: as fast as every consumer follows"), self.mode);
    visit(Field("rate", "real_time: sim seconds per second").in(kMinRate, kMaxRate), self.rate);
    visit(Field("start_paused", "wait for 'inslab resume' or 'inslab step' before the first sample"),
          self.start_paused);
    visit(Field("max_lag_ms", "real_time: a truth sample later than this ends the run as a fault").in(1.0, 1e5),
          self.max_lag_ms);
    visit(Field("ready_timeout_s", "how long the trajectory server waits for the services the scenario needs")
              .in(0.1, 3600.0),
          self.ready_timeout_s);
    visit(Field("whole_second_start", "real_time: begin at the next whole second of wall time"),
          self.whole_second_start);
  }
};

/// Readers that are not ours and without which the run must not begin.
struct RequiredSubscriber {
  std::string topic;
  std::uint32_t count = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("topic", "that of the truth, inslab/truth, or one of a sensor of the scenario, such as inslab/imu/0")
              .required(),
          self.topic);
    visit(Field("count", "how many readers besides ours").in(1.0, 64.0), self.count);
  }
};

/// The reference navigation app as the app under test.
struct ReferenceNav {
  std::uint32_t imu = 0;
  std::uint32_t gnss = 0;
  std::string parameters;
  std::optional<std::uint32_t> magnetometer = std::nullopt;
  std::optional<std::uint32_t> barometer = std::nullopt;
  std::optional<std::uint32_t> odometer = std::nullopt;
  std::optional<std::uint32_t> other_odometer = std::nullopt;
  std::optional<std::uint32_t> heading = std::nullopt;
  bool gravity_disturbance = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("imu", "the N of the inslab/imu/N that it navigates by").in(0.0, 63.0), self.imu);
    visit(Field("gnss", "the N of its inslab/gnss/N").in(0.0, 63.0), self.gnss);
    visit(Field("magnetometer", "the N of its inslab/magnetometer/N; absent: it takes none").in(0.0, 63.0),
          self.magnetometer);
    visit(Field("barometer", "the N of its inslab/barometer/N; absent: it takes none").in(0.0, 63.0), self.barometer);
    visit(Field("odometer", "the N of its inslab/odometer/N, on a wheel that is not steered; absent: it takes none")
              .in(0.0, 63.0),
          self.odometer);
    visit(Field("other_odometer", "the N of the odometer on the wheel across from it; absent: it takes one alone")
              .in(0.0, 63.0),
          self.other_odometer);
    visit(Field("heading", "the N of its inslab/heading/N; absent: it takes none").in(0.0, 63.0), self.heading);
    visit(Field("gravity_disturbance",
                "it estimates what gravity departs from its model by, with the sigmas and the distance that match "
                "trajectory.gravity, or those of the file of parameters; nothing where it does not depart"),
          self.gravity_disturbance);
    visit(Field("parameters",
                "file of the filter's parameters; absent: those that match the sensors' profiles and "
                "nominal installation")
              .at_most(4096),
          self.parameters);
  }
};

/// A whole scenario file.
struct Scenario {
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  Start start;
  double duration_s = 0.0;
  double truth_rate_hz = 200.0;
  Trajectory trajectory;
  std::vector<ImuSensor> imu;
  std::vector<GnssSensor> gnss;
  std::vector<MagnetometerSensor> magnetometer;
  std::vector<BarometerSensor> barometer;
  std::vector<OdometerSensor> odometer;
  std::vector<HeadingSensor> heading;
  std::vector<ScheduledSwap> swaps;
  std::string recordings_folder = "../recordings";
  Clock clock;
  std::vector<RequiredSubscriber> require_subscribers;
  bool require_nav_app = false;
  std::optional<ReferenceNav> reference_nav;
  std::vector<AcceptanceLimit> acceptance;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(Field("name", "for logs and reports").at_most(64).required(), self.name);
    visit(Field("description").at_most(1024), self.description);
    visit(Field("seed", "of every random stream: the same seed gives the same bits").required(), self.seed);
    visit(Field("start", "GPS time of sim time 0").required(), self.start);
    visit(Field("duration_s").in(1e-3, 1e7).required(), self.duration_s);
    visit(
        Field("truth_rate_hz", "the truth has a sample at each k/rate, and at every instant of a sensor").in(1.0, 1e4),
        self.truth_rate_hz);
    visit(Field("trajectory", "the vehicle's motion").required(), self.trajectory);
    visit(Field(catalog::Imu::name, "the IMUs of this unit").at_most(8), self.imu);
    visit(Field(catalog::Gnss::name, "the GNSS receivers of this unit").at_most(8), self.gnss);
    visit(Field(catalog::Magnetometer::name, "the magnetometers of this unit").at_most(8), self.magnetometer);
    visit(Field(catalog::Barometer::name, "the barometers of this unit").at_most(8), self.barometer);
    visit(Field(catalog::Odometer::name, "the odometers of this unit, one a wheel").at_most(8), self.odometer);
    visit(Field(catalog::Heading::name, "the receivers with two antennas of this unit").at_most(8), self.heading);
    visit(Field("swaps", "profiles swapped while the run goes on").at_most(10000), self.swaps);
    visit(Field("recordings_folder", "where recorded errors are that profiles name, relative to the scenario")
              .at_most(4096),
          self.recordings_folder);
    visit(Field("clock", "what sets the pace of a live run"), self.clock);
    visit(Field("require_subscribers", "readers that are not ours; the barrier waits for them").at_most(32),
          self.require_subscribers);
    visit(Field("require_nav_app",
                "the barrier waits for a writer of inslab/nav; in lockstep its imu_sequence sets the pace"),
          self.require_nav_app);
    visit(Field("reference_nav", "the reference navigation app takes part; absent: the app under test is another one"),
          self.reference_nav);
    visit(Field("acceptance", "limits that the app under test must keep; with one, a missing or late app fails")
              .at_most(256),
          self.acceptance);
  }
};

/// A key of ReferenceNav that names a sensor: `Number` is optional where the app can do without.
template <class Number>
struct AppKey {
  std::string_view name;
  Number ReferenceNav::*number;
};
template <class Number>
AppKey(const char*, Number ReferenceNav::*) -> AppKey<Number>;

/// Where the sensors of a kind stand in a scenario, and the keys by which the reference navigation app is given some of
/// them; none: it navigates by none of that kind.
template <class Kind>
struct Section;
template <>
struct Section<catalog::Imu> {
  static constexpr auto sensors = &Scenario::imu;
  static constexpr std::tuple of_the_app{AppKey{"imu", &ReferenceNav::imu}};
};
template <>
struct Section<catalog::Gnss> {
  static constexpr auto sensors = &Scenario::gnss;
  static constexpr std::tuple of_the_app{AppKey{"gnss", &ReferenceNav::gnss}};
};

template <>
struct Section<catalog::Magnetometer> {
  static constexpr auto sensors = &Scenario::magnetometer;
  static constexpr std::tuple of_the_app{AppKey{"magnetometer", &ReferenceNav::magnetometer}};
};

template <>
struct Section<catalog::Barometer> {
  static constexpr auto sensors = &Scenario::barometer;
  static constexpr std::tuple of_the_app{AppKey{"barometer", &ReferenceNav::barometer}};
};

template <>
struct Section<catalog::Odometer> {
  static constexpr auto sensors = &Scenario::odometer;
  static constexpr std::tuple of_the_app{AppKey{"odometer", &ReferenceNav::odometer},
                                         AppKey{"other_odometer", &ReferenceNav::other_odometer}};
};

template <>
struct Section<catalog::Heading> {
  static constexpr auto sensors = &Scenario::heading;
  static constexpr std::tuple of_the_app{AppKey{"heading", &ReferenceNav::heading}};
};

template <class Kind>
const auto& sensors_of(const Scenario& scenario) {
  return scenario.*Section<Kind>::sensors;
}

/// Whether the reference navigation app uses sensors of this kind at all.
template <class Kind>
inline constexpr bool is_navigated_by = std::tuple_size_v<std::decay_t<decltype(Section<Kind>::of_the_app)>> > 0;

namespace detail {
template <class Keys>
inline constexpr bool can_do_without = false;
template <class... Number>
inline constexpr bool can_do_without<std::tuple<AppKey<std::optional<Number>>...>> = sizeof...(Number) > 0;

template <class List>
struct AidKinds;
template <class... Kind>
struct AidKinds<Types<Kind...>> {
  template <class One>
  static constexpr bool is_aid = can_do_without<std::decay_t<decltype(Section<One>::of_the_app)>>;
  using type = Joined<std::conditional_t<is_aid<Kind>, Types<Kind>, Types<>>...>;
};
}  // namespace detail

/// The kinds of sensor that the app takes besides an IMU and a receiver, where its scenario says so: those whose keys
/// in ReferenceNav are optional. What it does with their streams is made for each of them.
using AidKinds = typename detail::AidKinds<catalog::SensorKinds>::type;

/// Calls `visit` with the key and the number of each sensor of that kind that the app navigates by.
template <class Kind, class Visit>
void for_each_of_the_app(const ReferenceNav& app, const Visit& visit) {
  for_each_of(Section<Kind>::of_the_app, [&](const auto& key) {
    const std::optional<std::uint32_t> number = app.*key.number;
    if (number) visit(key.name, *number);
  });
}

/// Whether the app navigates by that sensor.
template <class Kind>
bool is_of_the_app(const ReferenceNav& app, std::uint32_t number) {
  bool is_one = false;
  for_each_of_the_app<Kind>(app, [&](std::string_view, std::uint32_t one) { is_one = is_one || one == number; });
  return is_one;
}

/// Calls `visit` with the Tag of the kind and the sensor, for every sensor, kind by kind.
template <class Visit>
void for_each_sensor(const Scenario& scenario, const Visit& visit) {
  for_each(catalog::SensorKinds{}, [&](auto kind) {
    for (const auto& sensor : sensors_of<typename decltype(kind)::type>(scenario)) visit(kind, sensor);
  });
}

/// The first rule that the scenario breaks and that no single field's limits express, or nothing: instants
/// too near to each other, sensors given twice, swaps of sensors that are not there or after the end, broken
/// trajectories.
std::optional<Violation> violation(const Scenario& scenario);

/// The same of a schedule, as far as it can be told without a scenario.
std::optional<Violation> violation(const Schedule& schedule);

template <class Self, class Visitor>
void Start::fields(Self& self, Visitor& visit) {
  visit(Field("at", "gps_time: as given; now: the wall clock at the start").required(), self.at);
  if (self.at == StartAt::GpsTime) {
    visit(Field("gps_week", "full week, no rollover").in(0.0, time::kLastGpsWeek).required(), self.gps_week);
    visit(Field("gps_seconds_of_week_s").in(0.0, 604800.0).required(), self.gps_seconds_of_week_s);
  }
}

}  // namespace inslab::scenario

namespace inslab {

template <>
struct EnumNames<scenario::StartAt> {
  static constexpr std::string_view type = "StartAt";
  static constexpr std::string_view prefix = "START_";
  static constexpr std::array<std::string_view, 2> values{"gps_time", "now"};
};

}  // namespace inslab
