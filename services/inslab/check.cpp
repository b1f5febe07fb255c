#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/exit_code.hpp"
#include "config/files_read.hpp"
#include "scenario/load.hpp"
#include "services/inslab/commands.hpp"
#include "services/reference_nav/app_setup.hpp"
#include "services/reference_nav/parameters_file.hpp"

namespace inslab::cli {

namespace {

struct CheckOptions {
  std::string file;
  std::string kind = "scenario";
  std::string sensor_kind;
  bool lists_files = false;
};

template <class Enum>
std::optional<Enum> value_named(const std::string& name) {
  const auto& names = EnumNames<Enum>::values;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
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

int check_scenario(const std::string& file, bool lists_files) {
  const scenario::LoadedScenario loaded = scenario::load(file);
  if (const auto& app = loaded.scenario.reference_nav) (void)reference_nav::setup_for(loaded, *app);
  if (lists_files) {
    for (const std::string& path : config::files_read()) fmt::print("{}\n", path);
    return app::kOk;
  }
  fmt::print("{}: good: {:.3f} s at {} Hz, {}, {} IMUs, {} GNSS receivers, {} swaps\n", file,
             loaded.scenario.duration_s, loaded.scenario.truth_rate_hz, words_of(loaded), loaded.imus.size(),
             loaded.gnss.size(), loaded.swaps.size());
  return app::kOk;
}

int check_navigation(const std::string& file) {
  fmt::print("{}: good: navigation filter '{}'\n", file, reference_nav::read_parameters(file).name);
  return app::kOk;
}

int check_profile(const CheckOptions& options, ProfileKind kind) {
  const SensorKind usual = kind == ProfileKind::GnssError ? SensorKind::Gnss : SensorKind::Imu;
  const SensorKind sensor = value_named<SensorKind>(options.sensor_kind).value_or(usual);
  const AnyProfile profile = scenario::load_profile(options.file, kind, {sensor, 0});
  fmt::print("{}: good: {} profile '{}' for a sensor of the kind {}\n", options.file, enum_name(kind), name_of(profile),
             enum_name(sensor));
  return app::kOk;
}

}  // namespace

void add_check(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check",
      "Read a scenario and all it names, one profile or one filter's parameters; say what is wrong, or what is in it");
  command->add_option("file", options->file, "scenario, profile or file of config/nav (JSON)")->required();
  std::vector<std::string> kinds{"scenario", "navigation"};
  for (const std::string_view kind : EnumNames<ProfileKind>::values) kinds.emplace_back(kind);
  command->add_option("--kind", options->kind, "what the file is")->check(CLI::IsMember(kinds))->capture_default_str();
  command->add_option("--sensor", options->sensor_kind, "for a profile: the kind of sensor it goes to")
      ->check(CLI::IsMember({"imu", "gnss"}));
  command->add_flag("--files", options->lists_files, "for a scenario: print only the files that it takes, one a line");
  command->callback([options, &action] {
    action = [options] {
      if (options->kind == "navigation") return check_navigation(options->file);
      const auto kind = value_named<ProfileKind>(options->kind);
      return kind ? check_profile(*options, *kind) : check_scenario(options->file, options->lists_files);
    };
  });
}

}  // namespace inslab::cli
