#include "inslab/referee/montecarlo/study.hpp"

#include <fmt/format.h>

#include "inslab/data/json/json_writer.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::montecarlo {

namespace {

using json::Json;

std::string fingerprint_of(const std::string& text) { return fmt::format("{:016x}", random::seed_of(0, text)); }

/// The rows are part of the study; their file's name is not.
Json rows_json(const TrajectoryFile& file) {
  std::string text;
  for (const TrajectoryRow& row : file.rows) {
    text += fmt::format("{} {} {} {}", row.time.count(), row.position.latitude_rad, row.position.longitude_rad,
                        row.position.height_m);
    if (row.v_n) text += fmt::format(" {} {} {}", row.v_n->x(), row.v_n->y(), row.v_n->z());
    if (row.rpy) text += fmt::format(" {} {} {}", row.rpy->roll_rad, row.rpy->pitch_rad, row.rpy->yaw_rad);
    text += "\n";
  }
  return {{"rows", file.rows.size()}, {"fingerprint", fingerprint_of(text)}};
}

Json description_of(const Study& study, const std::string& version) {
  scenario::Scenario scenario = study.loaded.scenario;
  scenario.reference_nav->parameters.clear();  // they stand below, whatever their file is called
  Json description{{"version", version}, {"scenario", json::json_from_struct(scenario)}};
  if (study.loaded.trajectory_file) description["trajectory_file"] = rows_json(*study.loaded.trajectory_file);
  for_each_sensor(study.loaded, [&description](auto tag, const auto& sensor) {
    using Kind = typename decltype(tag)::type;
    Json profiles;
    for_each_of(scenario::LoadedSection<Kind>::profiles,
                [&](const auto& named) { profiles[named.word] = json::json_from_struct(sensor.*named.profile); });
    description[std::string(Kind::name)].push_back(profiles);
  });
  description["swaps"] = Json::array();
  for (const catalog::AnyProfile& swap : study.loaded.swaps) {
    description["swaps"].push_back(
        std::visit([](const auto& profile) { return json::json_from_struct(profile); }, swap));
  }
  description["filter"] = json::json_from_struct(study.app.parameters);
  description["filter_left_out"] = study.app.left_out;
  description["draw_start"] = study.draw_start;
  return description;
}

}  // namespace

Study load_study(const std::string& scenario_file, const std::string& parameters_file, bool draw_start,
                 const std::string& version) {
  Study study;
  study.loaded = scenario::load(scenario_file);
  scenario::Scenario& scenario = study.loaded.scenario;
  if (scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw files::ReadError(scenario_file +
                           ": trajectory.source is vehicle_state; expected one that needs no live vehicle");
  }
  if (!scenario.reference_nav) {
    if (scenario.imu.empty() || scenario.gnss.empty()) {
      throw files::ReadError(scenario_file + ": expected an IMU and a receiver for the filter to navigate by");
    }
    scenario.reference_nav = scenario::ReferenceNav{scenario.imu.front().number, scenario.gnss.front().number, ""};
  }
  if (!parameters_file.empty()) {
    scenario.reference_nav->parameters = std::filesystem::absolute(parameters_file).string();
  }
  study.app = navigation::setup_for(study.loaded, *scenario.reference_nav);
  study.draw_start = draw_start;
  study.description = description_of(study, version);
  study.fingerprint = fingerprint_of(study.description.dump());
  return study;
}

}  // namespace inslab::montecarlo
