#include "inslab/scenario/load.hpp"

#include "inslab/data/profiles/profile_rules.hpp"
#include "inslab/formats/trajectory/trajectory_judge.hpp"
#include "inslab/foundation/files/error.hpp"
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
  if (auto broken = violation(profile)) throw config::Error(file.string(), *broken);
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

LoadedImu load_imu(const std::filesystem::path& folder, const ImuSensor& sensor) {
  const SensorAddress target{SensorKind::Imu, sensor.number};
  LoadedImu imu;
  imu.number = sensor.number;
  imu.rate = time::Rate(sensor.rate_hz);
  imu.errors = named_profile<ImuErrorProfile>(folder, sensor.error_profile, target);
  imu.vibration = named_profile<VibrationProfile>(folder, sensor.vibration_profile, target);
  imu.installation = named_profile<InstallationProfile>(folder, sensor.installation_profile, target);
  imu.nominal_installation =
      sensor.nominal_installation_profile.empty()
          ? imu.installation
          : named_profile<InstallationProfile>(folder, sensor.nominal_installation_profile, target);
  return imu;
}

LoadedGnss load_gnss(const std::filesystem::path& folder, const GnssSensor& sensor) {
  const SensorAddress target{SensorKind::Gnss, sensor.number};
  LoadedGnss gnss;
  gnss.number = sensor.number;
  gnss.rate = time::Rate(sensor.rate_hz);
  gnss.errors = named_profile<GnssErrorProfile>(folder, sensor.error_profile, target);
  gnss.installation = named_profile<InstallationProfile>(folder, sensor.installation_profile, target);
  gnss.nominal_installation =
      sensor.nominal_installation_profile.empty()
          ? gnss.installation
          : named_profile<InstallationProfile>(folder, sensor.nominal_installation_profile, target);
  gnss.outages = sensor.outages;
  gnss.outage_areas = sensor.outage_areas;
  return gnss;
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
  const auto at = [](const char* list, std::size_t index) { return list + ("[" + std::to_string(index) + "]."); };
  for (std::size_t i = 0; i < scenario.imu.size(); ++i) {
    const ImuSensor& imu = scenario.imu[i];
    files.look_for_optional(at("imu", i) + "error_profile", imu.error_profile);
    files.look_for_optional(at("imu", i) + "vibration_profile", imu.vibration_profile);
    files.look_for_optional(at("imu", i) + "installation_profile", imu.installation_profile);
    files.look_for_optional(at("imu", i) + "nominal_installation_profile", imu.nominal_installation_profile);
  }
  for (std::size_t i = 0; i < scenario.gnss.size(); ++i) {
    const GnssSensor& gnss = scenario.gnss[i];
    files.look_for(at("gnss", i) + "error_profile", gnss.error_profile);
    files.look_for_optional(at("gnss", i) + "installation_profile", gnss.installation_profile);
    files.look_for_optional(at("gnss", i) + "nominal_installation_profile", gnss.nominal_installation_profile);
  }
  for (std::size_t i = 0; i < scenario.swaps.size(); ++i) {
    files.look_for(at("swaps", i) + "profile", scenario.swaps[i].profile);
  }
  return files.missing;
}

io::TrajectoryReading read_rows(const std::filesystem::path& file, const FileMotion& motion) {
  try {
    return io::read_trajectory(file.string(), {motion.columns, motion.topic, true});
  } catch (const io::ReadError& error) {
    const std::string prefix = file.string() + ": ";
    const std::string what = error.what();
    throw config::Error(file.string(),
                        {Rule::Readable, "", what.rfind(prefix, 0) == 0 ? what.substr(prefix.size()) : what});
  }
}

/// The rows of a trajectory's file, held to its limits and to what the method needs.
std::shared_ptr<const io::TrajectoryFile> load_rows(const std::filesystem::path& file, const FileMotion& motion) {
  io::TrajectoryReading reading = read_rows(file, motion);
  if (reading.problems.empty()) io::judge_trajectory(reading, motion.limits, true);
  if (!reading.problems.empty()) throw config::Error(file.string(), reading.problems.kept().front());
  const io::TrajectoryRow& first = reading.file.rows.front();
  if (motion.method == FileMethod::InverseMechanization && !(first.v_n && first.rpy)) {
    throw config::Error(file.string(), {Rule::MethodNeeds, "",
                                        std::string("has no ") + (first.v_n ? "attitude" : "velocity") +
                                            "; expected both for the method inverse_mechanization"});
  }
  return std::make_shared<const io::TrajectoryFile>(std::move(reading.file));
}

void check_rows_cover_run(const LoadedScenario& loaded) {
  const time::Nanoseconds last_sample =
      loaded.truth_grid().at_or_before(time::from_seconds(loaded.scenario.duration_s));
  const time::Nanoseconds last_row = loaded.trajectory_file->rows.back().time;
  if (last_sample <= last_row) return;
  throw config::Error(loaded.file.string(), {Rule::FileCoversRun, "duration_s",
                                             "is " + inslab::detail::number_text(loaded.scenario.duration_s) +
                                                 "; the rows of the trajectory's file reach to " +
                                                 inslab::detail::number_text(time::to_seconds(last_row)) + " s"});
}

/// Afterwards the scenario says all by itself: what is logged with a run needs no other file.
void take_segments_from_file(Trajectory& trajectory, const std::filesystem::path& folder) {
  if (trajectory.segments_file.empty()) return;
  trajectory.segments = read_motion_matrix(folder / trajectory.segments_file);
  trajectory.segments_file.clear();
}

}  // namespace

AnyProfile load_profile(const std::filesystem::path& file, ProfileKind kind, const SensorAddress& target) {
  switch (kind) {
    case ProfileKind::ImuError:
      return read_profile<ImuErrorProfile>(file, target);
    case ProfileKind::Vibration:
      return read_profile<VibrationProfile>(file, target);
    case ProfileKind::Installation:
      return read_profile<InstallationProfile>(file, target);
    case ProfileKind::GnssError:
      return read_profile<GnssErrorProfile>(file, target);
    case ProfileKind::Fault:
      break;
  }
  return read_profile<FaultProfile>(file, target);
}

LoadedScenario load(const std::filesystem::path& file, const std::string& unit, TrajectoryRows rows) {
  LoadedScenario loaded;
  loaded.file = file;
  loaded.unit = unit;
  loaded.scenario = read_document<Scenario>(file, DocumentKind::Scenario);
  const Scenario& scenario = loaded.scenario;
  if (auto broken = violation(scenario)) throw config::Error(file.string(), *broken);
  if (auto broken = missing_file(scenario, file.parent_path())) throw config::Error(file.string(), *broken);
  loaded.truth_rate = time::Rate(scenario.truth_rate_hz);
  const std::filesystem::path folder = file.parent_path();
  for (const ImuSensor& sensor : scenario.imu) loaded.imus.push_back(load_imu(folder, sensor));
  for (const GnssSensor& sensor : scenario.gnss) loaded.gnss.push_back(load_gnss(folder, sensor));
  loaded.truth_samples = 1 + loaded.truth_grid().index(time::from_seconds(scenario.duration_s));
  if (scenario.trajectory.source == TrajectorySource::File && rows == TrajectoryRows::Read) {
    loaded.trajectory_file = load_rows(folder / scenario.trajectory.file.path, scenario.trajectory.file);
    check_rows_cover_run(loaded);
  }
  take_segments_from_file(loaded.scenario.trajectory, folder);
  loaded.swaps = load_swaps(scenario.swaps, folder, 1);
  return loaded;
}

std::vector<AnyProfile> load_swaps(const std::vector<ScheduledSwap>& swaps, const std::filesystem::path& folder,
                                   std::uint64_t first_request_id) {
  std::vector<AnyProfile> requests;
  for (const ScheduledSwap& swap : swaps) {
    AnyProfile request = load_profile(folder / swap.profile, swap.kind, {swap.sensor_kind, swap.sensor_number});
    ProfileRequest& head = request_of(request);
    head.request_id = first_request_id + requests.size();
    head.apply_at_ns = time::from_seconds(swap.at_s).count();
    head.continuity = swap.continuity;
    head.fade_s = swap.fade_s;
    requests.push_back(std::move(request));
  }
  return requests;
}

std::vector<AnyProfile> load_schedule(const std::filesystem::path& file, std::uint64_t first_request_id) {
  const auto schedule = read_document<Schedule>(file, DocumentKind::Schedule);
  if (auto broken = violation(schedule)) throw config::Error(file.string(), *broken);
  NamedFiles files(file.parent_path());
  for (std::size_t i = 0; i < schedule.swaps.size(); ++i) {
    files.look_for("swaps[" + std::to_string(i) + "].profile", schedule.swaps[i].profile);
  }
  if (files.missing) throw config::Error(file.string(), *files.missing);
  return load_swaps(schedule.swaps, file.parent_path(), first_request_id);
}

time::Grid LoadedScenario::truth_grid() const {
  std::vector<time::Rate> rates{truth_rate};
  for (const LoadedImu& imu : imus) rates.push_back(imu.rate);
  for (const LoadedGnss& receiver : gnss) rates.push_back(receiver.rate);
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

const LoadedImu& LoadedScenario::imu_number(std::uint32_t number) const {
  for (const LoadedImu& imu : imus) {
    if (imu.number == number) return imu;
  }
  throw config::Error(file.string(), {Rule::SensorExists, "imu", "has no IMU number " + std::to_string(number)});
}

const LoadedGnss& LoadedScenario::gnss_number(std::uint32_t number) const {
  for (const LoadedGnss& receiver : gnss) {
    if (receiver.number == number) return receiver;
  }
  throw config::Error(file.string(),
                      {Rule::SensorExists, "gnss", "has no GNSS receiver number " + std::to_string(number)});
}

}  // namespace inslab::scenario
