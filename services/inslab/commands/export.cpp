#include <CLI/CLI.hpp>
#include <memory>
#include <stdexcept>

#include "inslab/formats/exports/export_request.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

int run_export(const exports::ExportRequest& options) {
  try {
    const exports::Exported exported = exports::export_as(options);
    for (const std::string& line : exported.made) terminal::tell("{}\n", line);
    for (const std::string& line : exported.left_out) terminal::tell(stderr, "inslab export: {}\n", line);
    return host::kOk;
  } catch (const files::ReadError& error) {
    terminal::tell(stderr, "inslab export: {}\n", error.what());
  } catch (const files::WriteError& error) {
    terminal::tell(stderr, "inslab export: {}\n", error.what());
  } catch (const std::invalid_argument& error) {
    terminal::tell(stderr, "inslab export: {}\n", error.what());
  } catch (const std::range_error& error) {
    terminal::tell(stderr, "inslab export: {}\n", error.what());
  }
  return host::kBadInput;
}

}  // namespace

void add_export(CLI::App& app, std::function<int()>& action) {
  CLI::App* command = app.add_subcommand("export", "A log in another format: tables of all topics, or a file of one");
  const auto options = std::make_shared<exports::ExportRequest>();
  const auto axes = std::make_shared<std::string>("rfu");
  command->add_option("log", options->log, "an MCAP log of Inslab")->required();
  command
      ->add_option(
          "--format", options->format,
          "csv: a folder of tables; hdf5: one file of tables; nav: truth or solution as 11 columns; imu, gnss: "
          "7 columns; kml: the track on a globe; novatel: RAWIMUSXA lines")
      ->required()
      ->check(host::one_of(exports::export_formats()));
  command->add_option("-o,--output", options->destination,
                      "the folder or file; when not given LOG_csv, LOG.h5, LOG.nav, LOG_imu.txt, ... beside the log");
  command
      ->add_option("--topic", options->topics,
                   "only this topic, such as inslab/truth; may be repeated for csv and hdf5")
      ->allow_extra_args(false);
  command
      ->add_option("--imu-type", options->novatel_imu_type,
                   "novatel: whose counts: " + exports::novatel_imu_types_text())
      ->capture_default_str();
  command->add_option("--axes", *axes, "novatel: of the counts: right-forward-up or forward-right-down")
      ->check(host::one_of({"rfu", "frd"}))
      ->capture_default_str();
  add_overwrite(*command);
  command->callback([&action, options, axes] {
    if (*axes == "frd") options->novatel_axes = novatel::NovatelAxes::ForwardRightDown;
    action = [options] { return run_export(*options); };
  });
}

}  // namespace inslab::commands
