#include "inslab/sim/scenario_folder.hpp"

#include "inslab/data/json/json_writer.hpp"
#include "inslab/formats/text/nav_text.hpp"
#include "inslab/foundation/files/output_file.hpp"

namespace inslab::cli {

namespace {

class Folder {
 public:
  explicit Folder(std::string path) : path_(std::move(path)) {}

  std::string path_of(const std::string& name) const { return path_ + "/" + name; }

  /// Writes what a declared struct says; returns the file's name.
  template <class T>
  std::string write(const std::string& name, const T& value) const {
    io::write_file(path_of(name), config::to_json(value).dump(2) + "\n");
    return name;
  }

  std::string write_rows(const std::string& name, const io::TrajectoryFile& trajectory) const {
    io::NavTextWriter file(path_of(name));
    for (const io::TrajectoryRow& row : trajectory.rows) file.write(trajectory.start + row.time, row);
    file.close();
    return name;
  }

 private:
  std::string path_;
};

}  // namespace

std::string write_scenario_folder(const scenario::LoadedScenario& loaded,
                                  const reference_nav::NavigationParameters& parameters, const std::string& folder) {
  const Folder files(folder);
  scenario::Scenario scenario = loaded.scenario;
  scenario.imu.clear();
  for (const scenario::LoadedImu& imu : loaded.imus) {
    const std::string stem = "imu" + std::to_string(imu.number);
    scenario::ImuSensor sensor;
    sensor.number = imu.number;
    sensor.rate_hz = imu.rate.hz();
    sensor.error_profile = files.write(stem + "_errors.json", imu.errors);
    sensor.vibration_profile = files.write(stem + "_vibration.json", imu.vibration);
    sensor.installation_profile = files.write(stem + "_installation.json", imu.installation);
    scenario.imu.push_back(sensor);
  }
  scenario.gnss.clear();
  for (const scenario::LoadedGnss& gnss : loaded.gnss) {
    const std::string stem = "gnss" + std::to_string(gnss.number);
    scenario::GnssSensor sensor;
    sensor.number = gnss.number;
    sensor.rate_hz = gnss.rate.hz();
    sensor.error_profile = files.write(stem + "_errors.json", gnss.errors);
    sensor.installation_profile = files.write(stem + "_installation.json", gnss.installation);
    sensor.outages = gnss.outages;
    sensor.outage_areas = gnss.outage_areas;
    scenario.gnss.push_back(sensor);
  }
  if (loaded.trajectory_file) {
    scenario.trajectory.file.path = files.write_rows("trajectory.nav", *loaded.trajectory_file);
  }
  if (scenario.reference_nav) scenario.reference_nav->parameters = files.write("navigation.json", parameters);
  return files.path_of(files.write("scenario.json", scenario));
}

}  // namespace inslab::cli
