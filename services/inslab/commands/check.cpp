#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <stdexcept>

#include "inslab/data/json/error.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/formats/text/imu_recording.hpp"
#include "inslab/foundation/files/error.hpp"
#include "inslab/foundation/files/files_read.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/referee/evidence/tell.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/motion_matrix.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/commands/file_kind.hpp"
#include "inslab/services/inslab/commands/trajectory_check.hpp"
#include "inslab/services/inslab/live/progress.hpp"
#include "inslab/sim/look_ahead.hpp"

namespace inslab::cli {

namespace {

struct CheckOptions {
  std::string file;
  std::string kind;  ///< empty: as the file's content says
  std::string sensor_kind;
  bool lists_files = false;
};

/// "FILE: good: ..."
int good(const std::string& file, const std::string& what) {
  tell("{}\n", text::shown(file + ": good: " + what));
  return app::kOk;
}

/// Where the motion comes from.
std::string words_of(const scenario::LoadedScenario& loaded) {
  const scenario::Trajectory& trajectory = loaded.scenario.trajectory;
  switch (trajectory.source) {
    case scenario::TrajectorySource::MotionTable:
      return fmt::format("{} segments", trajectory.segments.size());
    case scenario::TrajectorySource::File:
      return fmt::format("{} rows of a file", loaded.trajectory_file->rows.size());
    case scenario::TrajectorySource::Waypoints:
      return fmt::format("{} waypoints", trajectory.waypoints.size());
    case scenario::TrajectorySource::VehicleState:
      return "a live vehicle";
  }
  return "";
}

// A day of a soak would take minutes: as much as this is looked at.
constexpr double kLongestLook_s = 3600.0;

/// What the run will meet, or an error that names the limit that it breaks.
std::string ahead_of(const scenario::LoadedScenario& loaded) {
  const double span_s = std::min(loaded.scenario.duration_s, kLongestLook_s);
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    return "  the motion is the live vehicle's: its extremes show in the run\n";
  }
  std::optional<Progress> progress;
  const time::Nanoseconds begun = app::monotonic_now();
  const auto show = [&](time::Nanoseconds sim_time) {
    if (!progress && app::monotonic_now() - begun > std::chrono::seconds(2)) {
      progress.emplace(loaded.scenario.name + ": looking ahead", time::from_seconds(span_s));
    }
    if (progress) progress->show(sim_time);
  };
  try {
    return text_of(look_ahead(loaded, span_s, show));
  } catch (const std::domain_error& error) {
    throw config::Error(loaded.file.string(), {Rule::ValueRange, "trajectory", error.what()});
  }
}

int check_scenario(const std::string& file, bool lists_files) {
  const scenario::LoadedScenario loaded = scenario::load(file);
  if (const auto& app = loaded.scenario.reference_nav) (void)reference_nav::setup_for(loaded, *app);
  if (lists_files) {
    for (const std::string& path : config::files_read()) fmt::print("{}\n", path);
    return app::kOk;
  }
  const std::string ahead = ahead_of(loaded);
  std::string sensors;
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    sensors += fmt::format("{} {}, ", scenario::sensors_of<Kind>(loaded).size(), Kind::plural);
  });
  const int code =
      good(file, fmt::format("scenario of {:.3f} s at {} Hz, {}, {}{} swaps", loaded.scenario.duration_s,
                             loaded.scenario.truth_rate_hz, words_of(loaded), sensors, loaded.swaps.size()));
  tell("{}", ahead);
  return code;
}

int check_navigation(const std::string& file) {
  return good(file, fmt::format("navigation filter '{}'", reference_nav::read_parameters(file).name));
}

int check_profile(const CheckOptions& options, ProfileKind kind) {
  const SensorKind sensor =
      options.sensor_kind.empty() ? catalog::usual_sensor(kind) : enum_named<SensorKind>(options.sensor_kind).value();
  const AnyProfile profile = scenario::load_profile(options.file, kind, {sensor, 0});
  return good(options.file, fmt::format("{} profile '{}' for a sensor of the kind {}", enum_name(kind),
                                        name_of(profile), enum_name(sensor)));
}

int check_log(const std::string& file) {
  const io::McapReader log(file);
  const std::string ending = log.closed_properly() ? "closed properly" : "NOT closed properly: " + log.ending();
  return good(file, fmt::format("log of {} messages on {} topics, {}; inslab info and inslab summary say more",
                                log.statistics().message_count, log.channels().size(), ending));
}

int check_recording(const std::string& file) {
  const io::ImuRecordingInfo info = io::read_imu_recording(
      file, {}, [](const io::ImuRecordingInfo&) {}, [](const io::ImuIncrements&) {});
  return good(
      file, fmt::format("recording of an IMU, {}: {} samples at {:.6g} Hz", info.kind, info.samples, 1.0 / info.dt_s));
}

int check_novatel(const std::string& file) {
  io::NovatelImuReader reader(file);
  io::NovatelImuRecord record;
  while (reader.next(record)) continue;
  if (reader.record_count() == 0) {
    const std::string why = reader.bad_lines().empty()
                                ? ""
                                : "; the first: line " + std::to_string(reader.bad_lines().front().line) + ": " +
                                      reader.bad_lines().front().reason;
    throw io::ReadError(fmt::format("{}: is a log of NovAtel lines, none of which can be used: {} are bad{}", file,
                                    reader.bad_line_count(), why));
  }
  return good(file, fmt::format("log of NovAtel IMU lines: {} samples, {} bad lines, {} lines of other messages",
                                reader.record_count(), reader.bad_line_count(), reader.other_line_count()));
}

int check_document(const CheckOptions& options, const std::optional<scenario::DocumentKind>& kind,
                   const config::Json& json) {
  const bool has_name_alone =
      json.is_object() && json.contains("name") && json.size() == 1u + json.count("source") + json.count("$schema");
  // What resembles nothing is judged as a scenario, which says what is wrong with it.
  if (!kind && has_name_alone) {
    throw config::Error(
        options.file,
        {Rule::RequiredKey, "", "has nothing but a name, as a profile of each kind may; --kind says which it is"});
  }
  if (!kind || *kind == scenario::DocumentKind::Scenario) return check_scenario(options.file, options.lists_files);
  if (const auto profile = scenario::profile_of(*kind)) return check_profile(options, *profile);
  if (*kind == scenario::DocumentKind::Navigation) return check_navigation(options.file);
  if (*kind == scenario::DocumentKind::Schedule) {
    return good(options.file, fmt::format("schedule of {} swaps", scenario::load_schedule(options.file, 1).size()));
  }
  throw io::ReadError(options.file + ": is a lab's inventory; deploy/lab check says what is wrong with it, or in it");
}

int check(const CheckOptions& options) {
  if (options.kind == "scenario") return check_scenario(options.file, options.lists_files);
  if (options.kind == "navigation") return check_navigation(options.file);
  if (const auto kind = scenario::profile_kind_named(options.kind)) return check_profile(options, *kind);
  const FileKind found = file_kind(options.file);
  switch (found.form) {
    case FileKind::Form::Document:
      return check_document(options, found.document, found.json);
    case FileKind::Form::Log:
      return check_log(options.file);
    case FileKind::Form::Recording:
      return check_recording(options.file);
    case FileKind::Form::Trajectory:
      tell("{}: is a trajectory\n", text::shown(options.file));
      return check_trajectory(options.file);
    case FileKind::Form::MotionMatrix:
      return good(options.file,
                  fmt::format("matrix of {} segments", scenario::read_motion_matrix(options.file).size()));
    case FileKind::Form::NovatelLog:
      return check_novatel(options.file);
    case FileKind::Form::Unknown:
      break;
  }
  throw io::ReadError(options.file +
                      ": is nothing that is known here; expected a scenario, a profile, a filter's parameters, a "
                      "schedule, a log (MCAP), a trajectory or a recording of an IMU (docs/formats.md)");
}

}  // namespace

void add_check(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check", "Recognise a file by its content, read it and all it names; say what is wrong, or what is in it");
  command
      ->add_option(
          "file", options->file,
          "scenario, profile, schedule, filter's parameters (JSON), log (MCAP), trajectory or recording (text)")
      ->required();
  std::vector<std::string> kinds{"scenario", "navigation"};
  for (const std::string& word : scenario::profile_kind_words()) kinds.push_back(word);
  command->add_option("--kind", options->kind, "what the file must be; absent: what it is")->check(app::one_of(kinds));
  command->add_option("--sensor", options->sensor_kind, "for a profile: the kind of sensor it goes to")
      ->check(app::one_of(enum_words<SensorKind>()));
  command->add_flag("--files", options->lists_files, "for a scenario: print only the files that it takes, one a line");
  command->callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace inslab::cli
