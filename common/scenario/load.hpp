#pragma once

#include <filesystem>
#include <memory>
#include <tuple>

#include "inslab/data/samples/recorded_errors.hpp"
#include "inslab/data/samples/recorded_fix_errors.hpp"
#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/time/grid.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::scenario {

/// One IMU with its profiles read.
struct LoadedImu {
  std::uint32_t number = 0;
  time::Rate rate{200.0};
  ImuErrorProfile errors;
  VibrationProfile vibration;
  InstallationProfile installation;
  InstallationProfile nominal_installation;
};

/// One GNSS receiver with its profiles read.
struct LoadedGnss {
  std::uint32_t number = 0;
  time::Rate rate{5.0};
  GnssErrorProfile errors;
  InstallationProfile installation;
  InstallationProfile nominal_installation;
  std::vector<Outage> outages;
  std::vector<OutageArea> outage_areas;
};

/// One instrument of another kind with its profiles read.
template <class Errors>
struct LoadedInstrument {
  std::uint32_t number = 0;
  time::Rate rate{100.0};
  Errors errors;
  InstallationProfile installation;
  InstallationProfile nominal_installation;
};
using LoadedMagnetometer = LoadedInstrument<MagnetometerErrorProfile>;
using LoadedBarometer = LoadedInstrument<BarometerErrorProfile>;
using LoadedOdometer = LoadedInstrument<OdometerErrorProfile>;
struct LoadedHeading : LoadedInstrument<HeadingErrorProfile> {
  std::vector<Outage> outages;
  std::vector<OutageArea> outage_areas;
};

/// A scenario with every file it names read and checked.
struct LoadedScenario {
  std::filesystem::path file;
  Scenario scenario;
  time::Rate truth_rate{200.0};     ///< what the scenario asks for
  std::uint64_t truth_samples = 0;  ///< of truth_grid(), sample 0 included
  /// What the trajectory's file says, judged by its limits; null when the trajectory has none. Its rows reach from sim
  /// time 0 to the last sample at least, and they have what the method needs.
  std::shared_ptr<const TrajectoryFile> trajectory_file;
  std::shared_ptr<const nav::GravityGrid> gravity_grid;  ///< of trajectory.gravity.grid_file; null: it names none
  std::vector<LoadedImu> imus;
  std::vector<LoadedGnss> gnss;
  std::vector<LoadedMagnetometer> magnetometers;
  std::vector<LoadedBarometer> barometers;
  std::vector<LoadedOdometer> odometers;
  std::vector<LoadedHeading> headings;
  std::vector<catalog::AnyProfile> swaps;  ///< requests in order: target and request are filled in
  RecordingFinder recordings;              ///< of the scenario's folder of recordings; what it read it keeps
  FixRecordingFinder fix_recordings;       ///< the same, of receivers
  std::string unit;                        ///< the vehicle's name on the network; empty: it has none

  /// When the truth has samples: at its own rate, and at every instant of a sensor.
  time::Grid truth_grid() const;
  /// Sim time at which the scenario's duration is over.
  time::Nanoseconds end() const { return time::from_seconds(scenario.duration_s); }
  /// GPS time of sim time 0; with `start: now` that of `realtime_now` (CLOCK_REALTIME).
  time::GpsTime start(time::Nanoseconds realtime_now) const;
  /// The seed of the random streams: the scenario's, or, for a unit with a name, one drawn from that and the name, so
  /// that no two units share a stream.
  std::uint64_t stream_seed() const;
  /// The gravity that the scenario's options describe: what the vehicle feels.
  nav::Gravity gravity() const;
  /// Its model alone: what a navigation app knows of it.
  nav::Gravity gravity_model() const;
  /// What a filter may be told of the difference; nothing where there is none.
  std::optional<nav::GravityAlongWay> gravity_along_way() const;
  /// Where the vehicle begins; of a live vehicle, where it is until it reports.
  nav::Geodetic start_position() const;
  /// The sensor of that kind and number. Throws json::Error when the scenario has no such sensor.
  template <class Kind>
  const auto& sensor(std::uint32_t number) const;

 private:
  [[noreturn]] void no_such_sensor(std::string_view kind, const char* singular, std::uint32_t number) const;
};

/// A kind of profile that a sensor begins with: the key of its file in the scenario, and where the two of them stand.
template <class Sensor, class Loaded, class Profile>
struct NamedProfile {
  const char* key;
  const char* word;  ///< in what is derived from a scenario
  std::string Sensor::*file;
  Profile Loaded::*profile;
  bool is_required = false;
};

/// Where the sensors of a kind stand in a loaded scenario, and what they begin with.
template <class Kind>
struct LoadedSection;
template <>
struct LoadedSection<catalog::Imu> {
  static constexpr auto sensors = &LoadedScenario::imus;
  static constexpr std::tuple profiles{
      NamedProfile<ImuSensor, LoadedImu, ImuErrorProfile>{"error_profile", "errors", &ImuSensor::error_profile,
                                                          &LoadedImu::errors},
      NamedProfile<ImuSensor, LoadedImu, VibrationProfile>{"vibration_profile", "vibration",
                                                           &ImuSensor::vibration_profile, &LoadedImu::vibration},
      NamedProfile<ImuSensor, LoadedImu, InstallationProfile>{
          "installation_profile", "installation", &ImuSensor::installation_profile, &LoadedImu::installation}};
};
template <>
struct LoadedSection<catalog::Gnss> {
  static constexpr auto sensors = &LoadedScenario::gnss;
  static constexpr std::tuple profiles{
      NamedProfile<GnssSensor, LoadedGnss, GnssErrorProfile>{"error_profile", "errors", &GnssSensor::error_profile,
                                                             &LoadedGnss::errors, true},
      NamedProfile<GnssSensor, LoadedGnss, InstallationProfile>{
          "installation_profile", "installation", &GnssSensor::installation_profile, &LoadedGnss::installation}};
};

/// What an instrument begins with, which no scenario has to say.
template <class Sensor, class Loaded>
inline constexpr std::tuple kProfilesOfInstrument{
    NamedProfile<Sensor, Loaded, decltype(Loaded::errors)>{"error_profile", "errors", &Sensor::error_profile,
                                                           &Loaded::errors},
    NamedProfile<Sensor, Loaded, InstallationProfile>{"installation_profile", "installation",
                                                      &Sensor::installation_profile, &Loaded::installation}};
template <>
struct LoadedSection<catalog::Magnetometer> {
  static constexpr auto sensors = &LoadedScenario::magnetometers;
  static constexpr auto profiles = kProfilesOfInstrument<MagnetometerSensor, LoadedMagnetometer>;
};
template <>
struct LoadedSection<catalog::Barometer> {
  static constexpr auto sensors = &LoadedScenario::barometers;
  static constexpr auto profiles = kProfilesOfInstrument<BarometerSensor, LoadedBarometer>;
};
template <>
struct LoadedSection<catalog::Odometer> {
  static constexpr auto sensors = &LoadedScenario::odometers;
  static constexpr auto profiles = kProfilesOfInstrument<OdometerSensor, LoadedOdometer>;
};

template <>
struct LoadedSection<catalog::Heading> {
  static constexpr auto sensors = &LoadedScenario::headings;
  static constexpr std::tuple profiles{
      NamedProfile<HeadingSensor, LoadedHeading, HeadingErrorProfile>{
          "error_profile", "errors", &HeadingSensor::error_profile, &LoadedHeading::errors},
      NamedProfile<HeadingSensor, LoadedHeading, InstallationProfile>{"installation_profile", "installation",
                                                                      &HeadingSensor::installation_profile,
                                                                      &LoadedHeading::installation, true}};
};

template <class Kind>
const auto& sensors_of(const LoadedScenario& scenario) {
  return scenario.*LoadedSection<Kind>::sensors;
}
template <class Kind>
using Loaded = typename std::decay_t<decltype(sensors_of<Kind>(std::declval<LoadedScenario>()))>::value_type;

/// Calls `visit` with the Tag of the kind and the sensor, for every sensor, kind by kind.
template <class Visit>
void for_each_sensor(const LoadedScenario& scenario, const Visit& visit) {
  for_each(catalog::SensorKinds{}, [&](auto kind) {
    for (const auto& sensor : sensors_of<typename decltype(kind)::type>(scenario)) visit(kind, sensor);
  });
}

/// Calls `visit` with each profile that a sensor begins with.
template <class Kind, class Visit>
void for_each_profile(Tag<Kind>, const Loaded<Kind>& sensor, const Visit& visit) {
  for_each_of(LoadedSection<Kind>::profiles, [&](const auto& named) { visit(sensor.*named.profile); });
}

template <class Kind>
const auto& LoadedScenario::sensor(std::uint32_t number) const {
  for (const auto& one : sensors_of<Kind>(*this)) {
    if (one.number == number) return one;
  }
  no_such_sensor(Kind::name, Kind::singular, number);
}

/// The rows of a trajectory file: hours of them take hundreds of megabytes, and only who makes the truth needs them.
enum class TrajectoryRows { Read, LeaveOut };

/// Reads a scenario and everything it names, for the vehicle called `unit`. Throws json::Error naming file, path in
/// it and reason.
LoadedScenario load(const std::filesystem::path& file, const std::string& unit = {},
                    TrajectoryRows rows = TrajectoryRows::Read);

/// Reads a profile file of that kind, checks its limits and rules for the given target. Throws json::Error.
catalog::AnyProfile load_profile(const std::filesystem::path& file, ProfileKind kind, const SensorAddress& target);

/// Why the recording that a profile names cannot serve the run of a scenario; nothing when it can, or none is named.
std::optional<std::string> recording_problem(const catalog::AnyProfile& profile, const LoadedScenario& loaded);

/// The requests of a list of swaps, in order, numbered from `first_request_id`; profile files relative to `folder`.
/// Throws json::Error as load_profile() does.
std::vector<catalog::AnyProfile> load_swaps(const std::vector<ScheduledSwap>& swaps,
                                            const std::filesystem::path& folder, std::uint64_t first_request_id);

/// Reads a schedule of swaps and everything it names. Throws json::Error naming file, path in it and reason.
std::vector<catalog::AnyProfile> load_schedule(const std::filesystem::path& file, std::uint64_t first_request_id);

}  // namespace inslab::scenario
