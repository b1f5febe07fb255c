#include "inslab/sim/scenario_folder.hpp"

#include "inslab/data/json/json_writer.hpp"
#include "inslab/formats/recordings/nav_text.hpp"
#include "inslab/foundation/files/output_file.hpp"

namespace inslab::sim {

namespace {

class Folder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}

  std::string path_of(const std::string& name) const { return path_ + "/" + name; }

  /// Writes what a declared struct says; returns the file's name.
  template <class T>
  std::string write(const std::string& name, const T& value) const {
    files::write_file(path_of(name), json::json_from_struct(value).dump(2) + "\n");
    return name;
  }

  std::string write_rows(const std::string& name, const TrajectoryFile& trajectory) const {
    recordings::NavTextWriter file(path_of(name));
    for (const TrajectoryRow& row : trajectory.rows) file.write(trajectory.start + row.time, row);
    file.close();
    return name;
  }

 private:
  std::string path_;
};

/// The parts of a sensor that are no profile.
template <class Loaded, class Sensor>
void write_rest(const Loaded&, Sensor&) {}
void write_rest(const scenario::LoadedGnss& gnss, scenario::GnssSensor& sensor) {
  sensor.outages = gnss.outages;
  sensor.outage_areas = gnss.outage_areas;
}

}  // namespace

std::string write_scenario_folder(const scenario::LoadedScenario& loaded,
                                  const navigation::NavigationParameters& parameters, const std::string& folder) {
  const Folder files(folder);
  scenario::Scenario scenario = loaded.scenario;
  for_each(catalog::SensorKinds{}, [&](auto tag) {
    using Kind = typename decltype(tag)::type;
    auto& sensors = scenario.*scenario::Section<Kind>::sensors;
    sensors.clear();
    for (const auto& one : scenario::sensors_of<Kind>(loaded)) {
      auto& sensor = sensors.emplace_back();
      sensor.number = one.number;
      sensor.rate_hz = one.rate.hz();
      const std::string stem = std::string(Kind::name) + std::to_string(one.number);
      for_each_of(scenario::LoadedSection<Kind>::profiles, [&](const auto& named) {
        sensor.*named.file = files.write(stem + "_" + named.word + ".json", one.*named.profile);
      });
      write_rest(one, sensor);
    }
  });
  if (loaded.trajectory_file) {
    scenario.trajectory.file.path = files.write_rows("trajectory.nav", *loaded.trajectory_file);
  }
  if (scenario.reference_nav) scenario.reference_nav->parameters = files.write("navigation.json", parameters);
  return files.path_of(files.write("scenario.json", scenario));
}

}  // namespace inslab::sim
