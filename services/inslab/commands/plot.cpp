#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/report/track_picture.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {

namespace {

struct PlotOptions {
  std::string input;
  std::string directory = ".";
  std::string format = "svg";
};

int plot(const PlotOptions& options) {
  const std::filesystem::path input = options.input;
  const std::string name = input.stem().string();
  const Track track =
      input.extension() == ".mcap" ? track_of_log(options.input) : track_of_scenario(scenario::load(input));
  const io::PictureFormat format = options.format == "svg" ? io::PictureFormat::Svg : io::PictureFormat::Png;
  const std::string bytes = io::drawn(track.picture(name), format);
  std::filesystem::create_directories(options.directory);
  const std::string path = (std::filesystem::path(options.directory) / (name + "." + options.format)).string();
  io::write_file(path, bytes);
  tell("{} ({} KiB)\n", path, bytes.size() / 1024);
  return app::kOk;
}

}  // namespace

void add_plot(CLI::App& app, std::function<int()>& action) {
  CLI::App* command = app.add_subcommand(kPlot.name, kPlot.purpose);
  const auto options = std::make_shared<PlotOptions>();
  command->add_option("input", options->input, "scenario file (JSON) or log (MCAP)")->required();
  command->add_option("-o,--output", options->directory, "directory for the picture NAME.svg")->capture_default_str();
  command->add_option("--format", options->format, "svg or png")->check(app::one_of({"svg", "png"}));
  add_overwrite(*command);
  command->callback([&action, options] { action = [options] { return plot(*options); }; });
}

}  // namespace inslab::cli
