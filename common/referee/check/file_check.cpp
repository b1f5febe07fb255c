#include "inslab/referee/check/file_check.hpp"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "inslab/data/json/config_error.hpp"
#include "inslab/formats/mcap/mcap_reader.hpp"
#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/formats/recordings/imu_recording.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/files_read.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/referee/check/file_kind.hpp"
#include "inslab/referee/check/trajectory_check.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/scenario/motion_matrix.hpp"
#include "inslab/sim/look_ahead.hpp"

namespace inslab::check {

namespace {

/// "FILE: good: ..."
FileCheck good(const std::string& file, const std::string& what) {
  return {text::shown(file + ": good: " + what) + "\n", true};
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
std::string ahead_of(const scenario::LoadedScenario& loaded, const CheckOptions::Progress& progress) {
  const double span_s = std::min(loaded.scenario.duration_s, kLongestLook_s);
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    return "  the motion is the live vehicle's: its extremes show in the run\n";
  }
  const auto show = [&](time::Nanoseconds sim_time) {
    if (progress) progress(loaded.scenario.name, span_s, sim_time);
  };
  try {
    return sim::text_of(sim::look_ahead(loaded, span_s, show));
  } catch (const std::domain_error& error) {
    throw json::Error(loaded.file.string(), {Rule::ValueRange, "trajectory", error.what()});
  }
}

FileCheck check_scenario(const CheckOptions& options) {
  const scenario::LoadedScenario loaded = scenario::load(options.file);
  if (const auto& app = loaded.scenario.reference_nav) (void)navigation::setup_for(loaded, *app);
  if (options.lists_files) {
    FileCheck listed;
    for (const std::string& path : files::files_read()) listed.text += path + "\n";
    return listed;
  }
  const std::string ahead = ahead_of(loaded, options.progress);
  std::string sensors;
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    sensors += fmt::format("{} {}, ", scenario::sensors_of<Kind>(loaded).size(), Kind::plural);
  });
  FileCheck checked =
      good(options.file, fmt::format("scenario of {:.3f} s at {} Hz, {}, {}{} swaps", loaded.scenario.duration_s,
                                     loaded.scenario.truth_rate_hz, words_of(loaded), sensors, loaded.swaps.size()));
  checked.text += ahead;
  return checked;
}

FileCheck check_navigation(const std::string& file) {
  return good(file, fmt::format("navigation filter '{}'", navigation::read_parameters(file).name));
}

FileCheck check_profile(const CheckOptions& options, ProfileKind kind) {
  const SensorKind sensor =
      options.sensor_kind.empty() ? catalog::usual_sensor(kind) : enum_named<SensorKind>(options.sensor_kind).value();
  const catalog::AnyProfile profile = scenario::load_profile(options.file, kind, {sensor, 0});
  return good(options.file, fmt::format("{} profile '{}' for a sensor of the kind {}", enum_name(kind),
                                        catalog::name_of(profile), enum_name(sensor)));
}

FileCheck check_log(const std::string& file) {
  const mcap::McapReader log(file);
  const std::string ending = log.closed_properly() ? "closed properly" : "NOT closed properly: " + log.ending();
  return good(file, fmt::format("log of {} messages on {} topics, {}; inslab info and inslab summary say more",
                                log.statistics().message_count, log.channels().size(), ending));
}

FileCheck check_recording(const std::string& file) {
  const recordings::ImuRecordingInfo info = recordings::read_imu_recording(
      file, {}, [](const recordings::ImuRecordingInfo&) {}, [](const recordings::ImuIncrements&) {});
  return good(
      file, fmt::format("recording of an IMU, {}: {} samples at {:.6g} Hz", info.kind, info.samples, 1.0 / info.dt_s));
}

FileCheck check_novatel(const std::string& file) {
  novatel::NovatelImuReader reader(file);
  novatel::NovatelImuRecord record;
  while (reader.next(record)) continue;
  if (reader.record_count() == 0) {
    const std::string why = reader.bad_lines().empty()
                                ? ""
                                : "; the first: line " + std::to_string(reader.bad_lines().front().line) + ": " +
                                      reader.bad_lines().front().reason;
    throw files::ReadError(fmt::format("{}: is a log of NovAtel lines, none of which can be used: {} are bad{}", file,
                                       reader.bad_line_count(), why));
  }
  return good(file, fmt::format("log of NovAtel IMU lines: {} samples, {} bad lines, {} lines of other messages",
                                reader.record_count(), reader.bad_line_count(), reader.other_line_count()));
}

FileCheck check_document(const CheckOptions& options, const std::optional<scenario::DocumentKind>& kind,
                         const json::Json& json) {
  const bool has_name_alone =
      json.is_object() && json.contains("name") && json.size() == 1u + json.count("source") + json.count("$schema");
  // What resembles nothing is judged as a scenario, which says what is wrong with it.
  if (!kind && has_name_alone) {
    throw json::Error(options.file, {Rule::RequiredKey, "",
                                     "has nothing but a name, as a profile of each kind may; --kind says which it is"});
  }
  if (!kind || *kind == scenario::DocumentKind::Scenario) return check_scenario(options);
  if (const auto profile = scenario::profile_of(*kind)) return check_profile(options, *profile);
  if (*kind == scenario::DocumentKind::Navigation) return check_navigation(options.file);
  if (*kind == scenario::DocumentKind::Schedule) {
    return good(options.file, fmt::format("schedule of {} swaps", scenario::load_schedule(options.file, 1).size()));
  }
  throw files::ReadError(options.file +
                         ": is a lab's inventory; deploy/lab check says what is wrong with it, or in it");
}

FileCheck check_rows(const std::string& file) {
  TrajectoryCheckOptions options;
  options.file = file;
  const TrajectoryChecked checked = check_trajectory(options);
  return {text::shown(file) + ": is a trajectory\n" + checked.text, checked.is_good};
}

}  // namespace

FileCheck check_file(const CheckOptions& options) {
  if (options.kind == "scenario") return check_scenario(options);
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
      return check_rows(options.file);
    case FileKind::Form::MotionMatrix:
      return good(options.file,
                  fmt::format("matrix of {} segments", scenario::read_motion_matrix(options.file).size()));
    case FileKind::Form::NovatelLog:
      return check_novatel(options.file);
    case FileKind::Form::Unknown:
      break;
  }
  throw files::ReadError(options.file +
                         ": is nothing that is known here; expected a scenario, a profile, a filter's parameters, a "
                         "schedule, a log (MCAP), a trajectory or a recording of an IMU (docs/formats.md)");
}

}  // namespace inslab::check
