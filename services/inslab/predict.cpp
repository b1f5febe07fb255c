#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "io/error.hpp"
#include "io/output_file.hpp"
#include "io/picture.hpp"
#include "services/inslab/commands.hpp"
#include "services/inslab/predict/error_growth.hpp"
#include "services/trajectory_server/truth_model.hpp"

namespace inslab::cli {
namespace {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;
constexpr std::size_t kTableRows = 12;
constexpr double kStep_s = 1.0;

struct PredictOptions {
  std::string scenario;
  std::string directory = ".";
  std::uint32_t sensor_number = 0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double tilt_deg = 0.0;
  double yaw_deg = 0.0;
  bool hold_vertical = false;
};

predict::PredictedError start_of(const PredictOptions& options) {
  predict::PredictedError start;
  start.position_n_m.setConstant(options.position_m);
  start.velocity_n_m_per_s.setConstant(options.velocity_m_per_s);
  start.attitude_n_rad << options.tilt_deg / kDegPerRad, options.tilt_deg / kDegPerRad, options.yaw_deg / kDegPerRad;
  return start;
}

std::vector<predict::PredictedError> predicted(const scenario::LoadedScenario& loaded, const PredictOptions& options) {
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw io::ReadError(loaded.file.string() + ": follows a live vehicle, whose motion is not known beforehand");
  }
  const auto truth = trajectory::make_truth_model(loaded, loaded.start(app::realtime_now()));
  predict::ErrorGrowth growth(loaded.imu_number(options.sensor_number).errors, start_of(options), loaded.gravity(),
                              options.hold_vertical ? predict::Vertical::Held : predict::Vertical::Free, kStep_s);
  std::vector<predict::PredictedError> errors{growth.current()};
  for (std::uint64_t k = 1; k < loaded.truth_samples && loaded.truth_rate.at(k) <= truth->end(); ++k) {
    if (growth.advance(truth->advance())) errors.push_back(growth.current());
  }
  return errors;
}

using Figures = std::array<double, 10>;

Figures figures(const predict::PredictedError& error) {
  const nav::Vector3 attitude_deg = error.attitude_n_rad * kDegPerRad;
  const nav::Vector3 &r = error.position_n_m, &v = error.velocity_n_m_per_s;
  return {error.time_s, r.x(), r.y(), r.z(), v.x(), v.y(), v.z(), attitude_deg.x(), attitude_deg.y(), attitude_deg.z()};
}

void write(const std::string& path, const std::string& text) {
  io::OutputFile file(path);
  file.append(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  file.close();
  fmt::print("{} written\n", path);
}

std::string csv(const std::vector<predict::PredictedError>& errors) {
  std::string text =
      "time_s,position_north_m,position_east_m,position_down_m,velocity_north_m_per_s,velocity_east_m_per_s,"
      "velocity_down_m_per_s,phi_north_deg,phi_east_deg,phi_down_deg\n";
  for (const predict::PredictedError& error : errors) {
    text += fmt::format("{:.9g}\n", fmt::join(figures(error), ","));
  }
  return text;
}

std::string table(const std::vector<predict::PredictedError>& errors) {
  std::string text = fmt::format("{:>9}  {:>32}  {:>29}  {:>29}\n", "time, s", "position N E D, m",
                                 "velocity N E D, m/s", "phi N E D, deg");
  const std::size_t stride = std::max<std::size_t>(1, (errors.size() - 1) / kTableRows);
  for (std::size_t k = 0; k < errors.size(); k += stride) {
    const Figures f = figures(errors[k]);
    text +=
        fmt::format("{:>9.1f}  {:>10.3f} {:>10.3f} {:>10.3f}  {:>9.4f} {:>9.4f} {:>9.4f}  {:>9.5f} {:>9.5f} {:>9.5f}\n",
                    f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8], f[9]);
  }
  return text;
}

io::Picture picture_of(const std::vector<predict::PredictedError>& errors, const std::string& title) {
  const std::array<const char*, 3> quantities{"position, m", "velocity, m/s", "phi angle, deg"};
  const std::array<const char*, 3> axes{"north", "east", "down"};
  io::Picture picture;
  picture.title = title;
  picture.panel_width_px = 800;
  for (std::size_t quantity = 0; quantity < 3; ++quantity) {
    io::Panel panel;
    panel.x_label = "time, s";
    panel.y_label = quantities[quantity];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      io::Curve curve;
      curve.title = axes[axis];
      for (const predict::PredictedError& error : errors) {
        curve.x.push_back(error.time_s);
        curve.y.push_back(figures(error)[1 + 3 * quantity + axis]);
      }
      constexpr std::size_t kBins = 1000;
      panel.curves.push_back(io::thinned(curve, kBins));
    }
    picture.panels.push_back(panel);
  }
  return picture;
}

int run_predict(const PredictOptions& options) {
  const scenario::LoadedScenario loaded = scenario::load(options.scenario);
  const std::vector<predict::PredictedError> errors = predicted(loaded, options);
  fmt::print("{}: free inertial navigation with imu {} ({}), 1 sigma\n\n{}\n", loaded.scenario.name,
             options.sensor_number, options.hold_vertical ? "height held" : "height free", table(errors));
  std::filesystem::create_directories(options.directory);
  const std::string stem = (std::filesystem::path(options.directory) / (loaded.scenario.name + "_predicted")).string();
  write(stem + ".csv", csv(errors));
  write(stem + ".svg",
        io::drawn(picture_of(errors, loaded.scenario.name + ": expected errors, 1 sigma"), io::PictureFormat::Svg));
  return app::kOk;
}

}  // namespace

void add_predict(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<PredictOptions>();
  CLI::App* command = app.add_subcommand(
      "predict", "Errors to expect of free inertial navigation along a scenario, from its IMU's profile");
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_option("-o,--output", options->directory, "folder for NAME_predicted.csv and .svg")
      ->capture_default_str();
  command->add_option("--sensor", options->sensor_number, "the IMU's number")->capture_default_str();
  const auto sigma = [command](const char* name, double& value, const char* meaning) {
    command->add_option(name, value, meaning)->check(CLI::NonNegativeNumber)->capture_default_str();
  };
  sigma("--position", options->position_m, "sigma of each axis at the start, m");
  sigma("--velocity", options->velocity_m_per_s, "sigma of each axis at the start, m/s");
  sigma("--tilt", options->tilt_deg, "sigma of roll and pitch at the start, deg");
  sigma("--yaw", options->yaw_deg, "sigma of yaw at the start, deg");
  command->add_flag("--hold-vertical", options->hold_vertical, "height and vertical velocity are known");
  command->callback([options, &action] { action = [options] { return run_predict(*options); }; });
}

}  // namespace inslab::cli
