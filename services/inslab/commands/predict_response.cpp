#include "inslab/services/inslab/commands/predict_response.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/predict/model_file.hpp"

namespace inslab::commands {
namespace {

void write_and_say(const std::string& path, const std::string& text) {
  files::write_file(path, text);
  terminal::tell("{} written\n", path);
}

void write_responses(const std::vector<predict::Response>& responses, const std::string& directory,
                     const std::string& name, const std::string& heading) {
  terminal::tell("{}\n\n{}", heading, predict::table_text(responses));
  std::filesystem::create_directories(directory);
  const std::string stem = (std::filesystem::path(directory) / (name + "_response")).string();
  write_and_say(stem + ".csv", predict::csv_text(responses));
  write_and_say(stem + ".svg", tables::drawn(predict::picture_of(responses, heading), tables::PictureFormat::Svg));
}

int respond(const std::string& scenario, const std::string& directory, const ResponseRequest& request) {
  std::vector<predict::ErrorSource> sources;
  for (const std::string& text : request.sources) sources.push_back(predict::error_source(text));
  std::optional<scenario::LoadedScenario> loaded;
  if (!scenario.empty()) loaded = scenario::load(scenario);
  const nav::Gravity gravity = loaded ? loaded->gravity() : nav::Gravity();
  predict::Responses responses(sources, gravity, request.options.vertical());
  std::optional<predict::ModelFile> model;
  if (!request.model_file.empty()) model.emplace(request.model_file);
  const auto take = [&](const predict::LinearStep& step) {
    responses.add(step);
    if (model) model->add(step);
  };
  if (loaded) {
    predict::steps_along(*loaded, request.options, take);
  } else {
    predict::steps_at_rest(request.options, take);
  }
  if (model) {
    model->close();
    terminal::tell("{} written\n", request.model_file);
  }
  if (sources.empty()) return host::kOk;
  if (responses.list().front().time_s.empty()) return host::kFailed;
  const std::string name = loaded ? loaded->scenario.name : "rest";
  const std::string where = loaded ? name : fmt::format("rest at latitude {:g} deg", request.options.latitude_deg);
  write_responses(responses.list(), directory, name,
                  fmt::format("{}: signed response, {}; closed forms for a rest where it begins", where,
                              request.options.hold_vertical ? "height held" : "height free"));
  return host::kOk;
}

}  // namespace

void add_response_options(CLI::App& command, ResponseRequest& request) {
  command
      .add_option("--source", request.sources,
                  "the signed response to one constant error, such as gyro_bias_e=0.01deg/h; may be repeated: "
                  "position, velocity, phi along n, e, d; accel_bias, gyro_bias along n, e, d or x, y, z")
      ->allow_extra_args(false);
  command.add_option("--model", request.model_file, "write F and Phi of each step: FILE.csv, or HDF5 as FILE.h5");
  command.add_option("--latitude", request.latitude_deg, "of a rest without a scenario, deg")
      ->check(CLI::Range(-90.0, 90.0));
  command.add_option("--hours", request.options.hours, "of that rest")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--step", request.options.step_s, "of the model, s; otherwise 10 at rest, 0.2 along a scenario")
      ->check(CLI::Range(1e-3, 100.0));
}

int run_response(const std::string& scenario, const std::string& directory, ResponseRequest& request) {
  if (scenario.empty() == !request.latitude_deg || (request.sources.empty() && request.model_file.empty())) {
    terminal::tell(stderr, "inslab predict: expected a scenario, or --latitude with --source or --model\n");
    return host::kBadInput;
  }
  request.options.latitude_deg = request.latitude_deg.value_or(0.0);
  try {
    return respond(scenario, directory, request);
  } catch (const std::invalid_argument& error) {
    terminal::tell(stderr, "inslab predict: {}\n", error.what());
    return host::kBadInput;
  }
}

}  // namespace inslab::commands
