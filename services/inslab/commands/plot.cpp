#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/report/track_picture.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

struct PlotOptions {
  std::string input;
  std::string directory = ".";
  std::string format = "svg";
};

int plot(const PlotOptions& options) {
  const std::filesystem::path input = options.input;
  const std::string name = input.stem().string();
  const report::Track track = input.extension() == ".mcap" ? report::track_of_log(options.input)
                                                           : report::track_of_scenario(scenario::load(input));
  const tables::PictureFormat format =
      options.format == "svg" ? tables::PictureFormat::Svg : tables::PictureFormat::Png;
  const std::string bytes = tables::drawn(track.picture(name), format);
  std::filesystem::create_directories(options.directory);
  const std::string path = (std::filesystem::path(options.directory) / (name + "." + options.format)).string();
  files::write_file(path, bytes);
  terminal::tell("{} ({} KiB)\n", path, bytes.size() / 1024);
  return host::kOk;
}

}  // namespace

void add_plot(CLI::App& app, std::function<int()>& action) {
  CLI::App* command = app.add_subcommand(kPlot.name, kPlot.purpose);
  const auto options = std::make_shared<PlotOptions>();
  command->add_option("input", options->input, "scenario file (JSON) or log (MCAP)")->required();
  command->add_option("-o,--output", options->directory, "directory for the picture NAME.svg")->capture_default_str();
  command->add_option("--format", options->format, "svg or png")->check(host::one_of({"svg", "png"}));
  add_overwrite(*command);
  command->callback([&action, options] { action = [options] { return plot(*options); }; });
}

}  // namespace inslab::commands
