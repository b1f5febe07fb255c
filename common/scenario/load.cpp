#include "inslab/scenario/load.hpp"

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/formats/trajectory/trajectory_judge.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/noise/random/stream.hpp"
#include "inslab/scenario/motion_matrix.hpp"
#include "inslab/scenario/read_document.hpp"

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

/// The parts of a sensor that are no profile.
template <class Sensor, class LoadedSensor>
void load_rest(const Sensor&, LoadedSensor&) {}
void load_rest(const GnssSensor& sensor, LoadedGnss& gnss) {
  gnss.outages = sensor.outages;
  gnss.outage_areas = sensor.outage_areas;
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

trajectory::TrajectoryReading read_rows(const std::filesystem::path& file, const FileMotion& motion) {
  try {
    return trajectory::read_trajectory(file.string(), {motion.columns, motion.topic, true});
  } catch (const files::ReadError& error) {
    const std::string prefix = file.string() + ": ";
    const std::string what = error.what();
    throw json::Error(file.string(),
                      {Rule::Readable, "", what.rfind(prefix, 0) == 0 ? what.substr(prefix.size()) : what});
  }
}

/// The rows of a trajectory's file, held to its limits and to what the method needs.
std::shared_ptr<const TrajectoryFile> load_rows(const std::filesystem::path& file, const FileMotion& motion) {
  trajectory::TrajectoryReading reading = read_rows(file, motion);
  if (reading.problems.empty()) trajectory::judge_trajectory(reading, motion.limits, true);
  if (!reading.problems.empty()) throw json::Error(file.string(), reading.problems.kept().front());
  const TrajectoryRow& first = reading.file.rows.front();
  if (motion.method == FileMethod::InverseMechanization && !(first.v_n && first.rpy)) {
    throw json::Error(file.string(), {Rule::MethodNeeds, "",
                                      std::string("has no ") + (first.v_n ? "attitude" : "velocity") +
                                          "; expected both for the method inverse_mechanization"});
  }
  return std::make_shared<const TrajectoryFile>(std::move(reading.file));
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

/// Afterwards the scenario says all by itself: what is logged with a run needs no other file.
void take_segments_from_file(Trajectory& trajectory, const std::filesystem::path& folder) {
  if (trajectory.segments_file.empty()) return;
  trajectory.segments = read_motion_matrix(folder / trajectory.segments_file);
  trajectory.segments_file.clear();
}

}  // namespace

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
  loaded.swaps = load_swaps(scenario.swaps, folder, 1);
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
  return nav::Gravity(options.model,
                      {options.disturbance_mgal, options.deflection_north_arcsec, options.deflection_east_arcsec});
}

void LoadedScenario::no_such_sensor(std::string_view kind, const char* singular, std::uint32_t number) const {
  throw json::Error(file.string(), {Rule::SensorExists, std::string(kind),
                                    std::string("has no ") + singular + " number " + std::to_string(number)});
}

}  // namespace inslab::scenario
