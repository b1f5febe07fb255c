#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/predict/prediction.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/commands/predict_response.hpp"

namespace inslab::commands {
namespace {

struct PredictOptions {
  std::string scenario;
  std::string directory = ".";
  predict::PredictionOptions prediction;
  ResponseRequest response;
};

void write(const std::string& path, const std::string& text) {
  files::write_file(path, text);
  terminal::tell("{} written\n", path);
}

int run_predict(const PredictOptions& options) {
  const scenario::LoadedScenario loaded = scenario::load(options.scenario);
  const predict::Prediction prediction = predict::predicted(loaded, options.prediction);
  const std::vector<predict::PredictedError>& errors = prediction.errors.curve();
  if (errors.empty()) return host::kFailed;
  const std::vector<std::string> left_out = prediction.errors.left_out();
  terminal::tell("{}\n\n{}\n", predict::heading(loaded, options.prediction), predict::table_text(errors));
  if (!left_out.empty()) terminal::tell("left out: {}\n", fmt::join(left_out, ", "));
  std::filesystem::create_directories(options.directory);
  const std::string stem = (std::filesystem::path(options.directory) / (loaded.scenario.name + "_predicted")).string();
  write(stem + ".csv", predict::csv_text(errors));
  write(stem + ".svg", tables::drawn(predict::picture_of(prediction, loaded.scenario), tables::PictureFormat::Svg));
  return host::kOk;
}

}  // namespace

void add_predict(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<PredictOptions>();
  CLI::App* command = app.add_subcommand(kPredict.name, kPredict.purpose);
  command->add_option("scenario", options->scenario, "scenario file (JSON); without one a rest at --latitude");
  command->add_option("-o,--output", options->directory, "folder for NAME_predicted or NAME_response, .csv and .svg")
      ->capture_default_str();
  command->add_option("--sensor", options->prediction.sensor_number, "the IMU's number")->capture_default_str();
  const auto sigma = [command](const char* name, double& value, const char* meaning) {
    command->add_option(name, value, meaning)->check(CLI::NonNegativeNumber)->capture_default_str();
  };
  sigma("--position", options->prediction.position_m, "sigma of each axis at the start, m");
  sigma("--velocity", options->prediction.velocity_m_per_s, "sigma of each axis at the start, m/s");
  sigma("--tilt", options->prediction.tilt_deg, "sigma of roll and pitch at the start, deg");
  sigma("--yaw", options->prediction.yaw_deg, "sigma of yaw at the start, deg");
  command->add_flag("--free-inertial", options->prediction.free_inertial,
                    "without the fixes of the scenario's first receiver");
  command->add_flag("--plumb-line", options->prediction.plumb_line,
                    "the start is levelled: it leans as gravity's departure from its model has the plumb line lean");
  command->add_flag("--hold-vertical", options->prediction.hold_vertical, "height and vertical velocity are known");
  add_response_options(*command, options->response);
  add_overwrite(*command);
  command->callback([options, &action] {
    action = [options] {
      if (!options->response.is_asked_for(options->scenario)) return run_predict(*options);
      options->response.options.sensor_number = options->prediction.sensor_number;
      options->response.options.hold_vertical = options->prediction.hold_vertical;
      return run_response(options->scenario, options->directory, options->response);
    };
  });
}

}  // namespace inslab::commands
