#include "inslab/scenario/load.hpp"

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/data/profiles/fix_recording_place.hpp"
#include "inslab/data/profiles/recording_place.hpp"
#include "inslab/formats/recordings/gravity_text.hpp"
#include "inslab/formats/recordings/recording_shelf.hpp"
#include "inslab/formats/trajectory/trajectory_judge.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/noise/random/stream.hpp"
#include "inslab/scenario/motion_matrix.hpp"
#include "inslab/scenario/read_document.hpp"
#include "inslab/scenario/terrain_gravity.hpp"

namespace inslab::scenario {

namespace {

template <class Profile>
Profile read_profile(const std::filesystem::path& file, const SensorAddress& target) {
  auto profile = read_document<Profile>(file, document_of(Profile::kind));
  profile.target = target;
  if (auto broken = catalog::violation(profile)) throw json::Error(file.string(), *broken);
  return profile;
}

/// The profile a scenario names, relative to the scenario; an empty name leaves the default.
template <class Profile>
Profile named_profile(const std::filesystem::path& folder, const std::string& name, const SensorAddress& target) {
  if (name.empty()) {
    Profile profile;
    profile.target = target;
    profile.name = "default";
    return profile;
  }
  return read_profile<Profile>(folder / name, target);
}

template <class Place>
nav::Geodetic position_of(const Place& place) {
  return {place.latitude_deg * units::kDeg, place.longitude_deg * units::kDeg, place.height_m};
}

/// The parts of a sensor that are no profile.
template <class Sensor, class LoadedSensor>
void load_rest(const Sensor&, LoadedSensor&) {}
void load_rest(const GnssSensor& sensor, LoadedGnss& gnss) {
  gnss.outages = sensor.outages;
  gnss.outage_areas = sensor.outage_areas;
}
void load_rest(const HeadingSensor& sensor, LoadedHeading& heading) {
  heading.outages = sensor.outages;
  heading.outage_areas = sensor.outage_areas;
}

template <class Kind, class Sensor>
Loaded<Kind> load_sensor(const std::filesystem::path& folder, const Sensor& sensor) {
  const SensorAddress target{Kind::kind, sensor.number};
  Loaded<Kind> loaded;
  loaded.number = sensor.number;
  loaded.rate = time::Rate(sensor.rate_hz);
  for_each_of(LoadedSection<Kind>::profiles, [&](const auto& named) {
    auto& profile = loaded.*named.profile;
    profile = named_profile<std::decay_t<decltype(profile)>>(folder, sensor.*named.file, target);
  });
  loaded.nominal_installation =
      sensor.nominal_installation_profile.empty()
          ? loaded.installation
          : named_profile<InstallationProfile>(folder, sensor.nominal_installation_profile, target);
  load_rest(sensor, loaded);
  return loaded;
}

/// Looks for the files that a scenario names before any is read, so that the message can say who named it.
class NamedFiles {
 public:
  explicit NamedFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void look_for(const std::string& path, const std::string& name) {
    std::error_code error;
    if (missing || std::filesystem::is_regular_file(folder_ / name, error)) return;
    const std::filesystem::path whole = std::filesystem::absolute(folder_ / name, error).lexically_normal();
    missing = Violation{Rule::NamedFile, path,
                        "names " + text::quoted(name) + ", which is not there" +
                            (error ? "" : "; it was looked for as " + whole.string())};
  }
  void look_for_optional(const std::string& path, const std::string& name) {
    if (!name.empty()) look_for(path, name);
  }

  std::optional<Violation> missing;

 private:
  std::filesystem::path folder_;
};

std::optional<Violation> missing_file(const Scenario& scenario, const std::filesystem::path& folder) {
  NamedFiles files(folder);
  const Trajectory& trajectory = scenario.trajectory;
  if (trajectory.source == TrajectorySource::File) files.look_for("trajectory.file.path", trajectory.file.path);
  files.look_for_optional("trajectory.segments_file", trajectory.segments_file);
  files.look_for_optional("trajectory.gravity.grid_file", trajectory.gravity.grid_file);
  const auto at = [](const std::string& list, std::size_t index) { return list + "[" + std::to_string(index) + "]."; };
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    const auto& sensors = sensors_of<Kind>(scenario);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const std::string place = at(std::string(Kind::name), i);
      for_each_of(LoadedSection<Kind>::profiles, [&](const auto& named) {
        const std::string& name = sensors[i].*named.file;
        named.is_required ? files.look_for(place + named.key, name) : files.look_for_optional(place + named.key, name);
      });
      files.look_for_optional(place + "nominal_installation_profile", sensors[i].nominal_installation_profile);
    }
  });
  for (std::size_t i = 0; i < scenario.swaps.size(); ++i) {
    files.look_for(at("swaps", i) + "profile", scenario.swaps[i].profile);
  }
  return files.missing;
}

/// What `read` makes of a file; what is wrong with that is an error of the configuration.
template <class Read>
auto reading(const std::filesystem::path& file, const Read& read) {
  try {
    return read();
  } catch (const files::ReadError& error) {
    const std::string prefix = file.string() + ": ";
    const std::string what = error.what();
    throw json::Error(file.string(),
                      {Rule::Readable, "", what.rfind(prefix, 0) == 0 ? what.substr(prefix.size()) : what});
  }
}

/// The rows of a trajectory's file, held to its limits and to what the method needs.
std::shared_ptr<const TrajectoryFile> load_rows(const std::filesystem::path& file, const FileMotion& motion) {
  trajectory::TrajectoryReading rows = reading(file, [&] {
    return trajectory::read_trajectory(file.string(), {motion.columns, motion.topic, true});
  });
  if (rows.problems.empty()) trajectory::judge_trajectory(rows, motion.limits, true);
  if (!rows.problems.empty()) throw json::Error(file.string(), rows.problems.kept().front());
  const TrajectoryRow& first = rows.file.rows.front();
  if (motion.method == FileMethod::InverseMechanization && !(first.v_n && first.rpy)) {
    throw json::Error(file.string(), {Rule::MethodNeeds, "",
                                      std::string("has no ") + (first.v_n ? "attitude" : "velocity") +
                                          "; expected both for the method inverse_mechanization"});
  }
  return std::make_shared<const TrajectoryFile>(std::move(rows.file));
}

/// A class has nothing to do where the rows have an attitude: who names one believes that it does.
void check_class_is_of_use(const LoadedScenario& loaded) {
  const FileMotion& motion = loaded.scenario.trajectory.file;
  const VehicleClass vehicle_class = motion.attitude_from_path.vehicle_class;
  if (motion.method != FileMethod::Spline || vehicle_class == VehicleClass::NoseAlongTrack) return;
  if (!loaded.trajectory_file->rows.front().rpy) return;
  throw json::Error(loaded.file.string(),
                    {Rule::FileAttitude, "trajectory.file.attitude_from_path.vehicle_class",
                     "is " + std::string(enum_name(vehicle_class)) +
                         "; the rows have an attitude of their own, which holds; expected no vehicle_class, or a "
                         "file without attitude"});
}

void check_rows_cover_run(const LoadedScenario& loaded) {
  const time::Nanoseconds last_sample =
      loaded.truth_grid().at_or_before(time::from_seconds(loaded.scenario.duration_s));
  const time::Nanoseconds last_row = loaded.trajectory_file->rows.back().time;
  if (last_sample <= last_row) return;
  throw json::Error(loaded.file.string(),
                    {Rule::FileCoversRun, "duration_s",
                     "is " + number_text(loaded.scenario.duration_s) + "; the rows of the trajectory's file reach to " +
                         number_text(time::to_seconds(last_row)) + " s"});
}

/// A swap is in effect for the samples after its time: one without such a sample is never acknowledged.
void check_swaps_are_seen(const LoadedScenario& loaded) {
  const time::Nanoseconds end = time::from_seconds(loaded.scenario.duration_s);
  for (std::size_t i = 0; i < loaded.scenario.swaps.size(); ++i) {
    const ScheduledSwap& swap = loaded.scenario.swaps[i];
    time::Nanoseconds last{0};
    for_each_sensor(loaded.scenario, [&](auto tag, const auto& sensor) {
      const bool is_it = decltype(tag)::type::kind == swap.sensor_kind && sensor.number == swap.sensor_number;
      if (const time::Rate rate(sensor.rate_hz); is_it) last = rate.at(rate.index(end));
    });
    if (loaded.truth_grid().at_or_after(time::from_seconds(swap.at_s)) < last) continue;
    throw json::Error(loaded.file.string(),
                      {Rule::SwapBeforeEnd, "swaps[" + std::to_string(i) + "].at_s",
                       "is " + number_text(swap.at_s) + "; the last sample of " +
                           catalog::sensor_name({swap.sensor_kind, swap.sensor_number}) + " is at " +
                           number_text(time::to_seconds(last)) + " s, so none would come out under it"});
  }
}

/// Afterwards the scenario says all by itself: what is logged with a run needs no other file.
void take_segments_from_file(Trajectory& trajectory, const std::filesystem::path& folder) {
  if (trajectory.segments_file.empty()) return;
  trajectory.segments = read_motion_matrix(folder / trajectory.segments_file);
  trajectory.segments_file.clear();
}

/// The grid must have the places of which the scenario itself speaks.
void load_gravity_grid(LoadedScenario& loaded) {
  const std::string& name = loaded.scenario.trajectory.gravity.grid_file;
  if (name.empty()) return;
  const std::filesystem::path file = loaded.file.parent_path() / name;
  const auto grid = reading(file, [&file] { return recordings::read_gravity_grid(file.string()); });
  loaded.gravity_grid = std::make_shared<const nav::GravityGrid>(grid);
  const auto must_contain = [&](const nav::Geodetic& place, const std::string& what) {
    if (grid.contains(place)) return;
    throw json::Error(loaded.file.string(),
                      {Rule::GravityGrid, "trajectory.gravity.grid_file",
                       "names " + text::quoted(name) + ", which does not reach to " + what + ", latitude " +
                           std::to_string(place.latitude_rad * units::kDegPerRad) + ", longitude " +
                           std::to_string(place.longitude_rad * units::kDegPerRad) + " deg"});
  };
  must_contain(loaded.start_position(), "the start");
  if (loaded.scenario.trajectory.source == TrajectorySource::Waypoints) {
    const auto& waypoints = loaded.scenario.trajectory.waypoints;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      must_contain(position_of(waypoints[i]), "waypoint " + std::to_string(i));
    }
  }
  if (!loaded.trajectory_file) return;
  for (std::size_t i = 0; i < loaded.trajectory_file->rows.size(); ++i) {
    must_contain(loaded.trajectory_file->rows[i].position, "row " + std::to_string(i) + " of the trajectory");
  }
}

void use_recordings_of(const std::filesystem::path& folder, LoadedScenario& loaded) {
  auto shelf = std::make_shared<recordings::RecordingShelf>(folder);
  loaded.recordings = [shelf](const auto& file, const auto& sha256) { return shelf->find_imu(file, sha256); };
  loaded.fix_recordings = [shelf](const auto& file, const auto& sha256) { return shelf->find_fixes(file, sha256); };
}

void check_recordings(const LoadedScenario& loaded) {
  const auto check = [&loaded](const std::string& path, const catalog::AnyProfile& profile) {
    if (const auto problem = recording_problem(profile, loaded)) {
      throw json::Error(loaded.file.string(),
                        {Rule::RecordingFits, path, "names a profile whose recorded_error cannot be had: " + *problem});
    }
  };
  for (std::size_t i = 0; i < loaded.imus.size(); ++i) {
    check("imu[" + std::to_string(i) + "].error_profile", loaded.imus[i].errors);
  }
  for (std::size_t i = 0; i < loaded.gnss.size(); ++i) {
    check("gnss[" + std::to_string(i) + "].error_profile", loaded.gnss[i].errors);
  }
  for (std::size_t i = 0; i < loaded.swaps.size(); ++i) {
    check("swaps[" + std::to_string(i) + "].profile", loaded.swaps[i]);
  }
}

}  // namespace

std::optional<std::string> recording_problem(const catalog::AnyProfile& profile, const LoadedScenario& loaded) {
  const auto* imu = std::get_if<ImuErrorProfile>(&profile);
  const auto* gnss = std::get_if<GnssErrorProfile>(&profile);
  try {
    if (imu != nullptr && !imu->recorded_error.file.empty()) {
      const RecordedError& recorded = imu->recorded_error;
      profiles::place_of(*loaded.recordings(recorded.file, recorded.sha256), recorded, loaded.end(), 0.0);
    } else if (gnss != nullptr && !gnss->recorded_error.file.empty()) {
      const RecordedFixError& recorded = gnss->recorded_error;
      profiles::begin_of(*loaded.fix_recordings(recorded.file, recorded.sha256), recorded, loaded.end(), 0.0);
    }
  } catch (const std::exception& error) {
    return error.what();
  }
  return std::nullopt;
}

catalog::AnyProfile load_profile(const std::filesystem::path& file, ProfileKind kind, const SensorAddress& target) {
  catalog::AnyProfile profile;
  catalog::with_profile(kind, [&](auto tag) { profile = read_profile<typename decltype(tag)::type>(file, target); });
  return profile;
}

LoadedScenario load(const std::filesystem::path& file, const std::string& unit, TrajectoryRows rows) {
  LoadedScenario loaded;
  loaded.file = file;
  loaded.unit = unit;
  loaded.scenario = read_document<Scenario>(file, DocumentKind::Scenario);
  const Scenario& scenario = loaded.scenario;
  if (auto broken = violation(scenario)) throw json::Error(file.string(), *broken);
  if (auto broken = missing_file(scenario, file.parent_path())) throw json::Error(file.string(), *broken);
  loaded.truth_rate = time::Rate(scenario.truth_rate_hz);
  const std::filesystem::path folder = file.parent_path();
  for_each_sensor(scenario, [&](auto tag, const auto& sensor) {
    using Kind = typename decltype(tag)::type;
    (loaded.*LoadedSection<Kind>::sensors).push_back(load_sensor<Kind>(folder, sensor));
  });
  loaded.truth_samples = 1 + loaded.truth_grid().index(time::from_seconds(scenario.duration_s));
  if (scenario.trajectory.source == TrajectorySource::File && rows == TrajectoryRows::Read) {
    loaded.trajectory_file = load_rows(folder / scenario.trajectory.file.path, scenario.trajectory.file);
    check_class_is_of_use(loaded);
    check_rows_cover_run(loaded);
  }
  take_segments_from_file(loaded.scenario.trajectory, folder);
  load_gravity_grid(loaded);
  check_swaps_are_seen(loaded);
  loaded.swaps = load_swaps(scenario.swaps, folder, 1);
  use_recordings_of(folder / scenario.recordings_folder, loaded);
  check_recordings(loaded);
  return loaded;
}

std::vector<catalog::AnyProfile> load_swaps(const std::vector<ScheduledSwap>& swaps,
                                            const std::filesystem::path& folder, std::uint64_t first_request_id) {
  std::vector<catalog::AnyProfile> requests;
  for (const ScheduledSwap& swap : swaps) {
    catalog::AnyProfile request =
        load_profile(folder / swap.profile, swap.kind, {swap.sensor_kind, swap.sensor_number});
    ProfileRequest& head = catalog::request_of(request);
    head.request_id = first_request_id + requests.size();
    head.apply_at_ns = time::from_seconds(swap.at_s).count();
    head.continuity = swap.continuity;
    head.fade_s = swap.fade_s;
    requests.push_back(std::move(request));
  }
  return requests;
}

std::vector<catalog::AnyProfile> load_schedule(const std::filesystem::path& file, std::uint64_t first_request_id) {
  const auto schedule = read_document<Schedule>(file, DocumentKind::Schedule);
  if (auto broken = violation(schedule)) throw json::Error(file.string(), *broken);
  NamedFiles files(file.parent_path());
  for (std::size_t i = 0; i < schedule.swaps.size(); ++i) {
    files.look_for("swaps[" + std::to_string(i) + "].profile", schedule.swaps[i].profile);
  }
  if (files.missing) throw json::Error(file.string(), *files.missing);
  return load_swaps(schedule.swaps, file.parent_path(), first_request_id);
}

time::Grid LoadedScenario::truth_grid() const {
  std::vector<time::Rate> rates{truth_rate};
  for_each_sensor(*this, [&rates](auto, const auto& sensor) { rates.push_back(sensor.rate); });
  return time::Grid(rates);
}

time::GpsTime LoadedScenario::start(time::Nanoseconds realtime_now) const {
  if (scenario.start.at == StartAt::Now) return time::gps_from_realtime(realtime_now);
  return {scenario.start.gps_week, time::from_seconds(scenario.start.gps_seconds_of_week_s).count()};
}

std::uint64_t LoadedScenario::stream_seed() const {
  return unit.empty() ? scenario.seed : random::seed_of(scenario.seed, "unit/" + unit);
}

nav::Gravity LoadedScenario::gravity() const {
  const GravityOptions& options = scenario.trajectory.gravity;
  std::shared_ptr<const nav::GravityField> field;
  if (options.variation) {
    field = std::make_shared<nav::GravityField>(gravity_field(*options.variation, start_position(), scenario.seed));
  }
  return nav::Gravity(options.model, constant_disturbance(options), std::move(field), gravity_grid);
}

std::optional<nav::GravityAlongWay> LoadedScenario::gravity_along_way() const {
  return scenario::gravity_along_way(scenario.trajectory.gravity, gravity_grid.get());
}

nav::Gravity LoadedScenario::gravity_model() const { return nav::Gravity(scenario.trajectory.gravity.model); }

nav::Geodetic LoadedScenario::start_position() const {
  const Trajectory& trajectory = scenario.trajectory;
  if (trajectory.source == TrajectorySource::File && trajectory_file) return trajectory_file->rows.front().position;
  if (trajectory.source == TrajectorySource::Waypoints && !trajectory.waypoints.empty())
    return position_of(trajectory.waypoints.front());
  return position_of(trajectory.initial);
}

void LoadedScenario::no_such_sensor(std::string_view kind, const char* singular, std::uint32_t number) const {
  throw json::Error(file.string(), {Rule::SensorExists, std::string(kind),
                                    std::string("has no ") + singular + " number " + std::to_string(number)});
}

}  // namespace inslab::scenario
