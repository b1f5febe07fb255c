#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "inslab/formats/export/log_export.hpp"
#include "inslab/formats/export/log_file_export.hpp"
#include "inslab/foundation/files/error.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {
namespace {

struct ExportOptions {
  std::string log;
  std::string format;
  std::string destination;
  std::vector<std::string> topics;
  std::uint32_t imu_type = io::FileExportOptions{}.novatel_imu_type;
  std::string axes = "rfu";
};

/// The formats that make one file of one topic, and what the file's name ends in.
struct NamedFormat {
  const char* name;
  io::FileFormat format;
  const char* ending;
};
constexpr NamedFormat kFileFormats[] = {{"nav", io::FileFormat::Nav, ".nav"},
                                        {"imu", io::FileFormat::Imu, "_imu.txt"},
                                        {"gnss", io::FileFormat::Gnss, "_gnss.txt"},
                                        {"kml", io::FileFormat::Kml, ".kml"},
                                        {"novatel", io::FileFormat::Novatel, "_novatel.txt"}};

/// run.mcap gives run_csv, run.h5, run.nav, ..., beside the log.
std::string default_destination(const std::string& log, const std::string& ending) {
  constexpr std::string_view kSuffix = ".mcap";
  std::string stem = log;
  if (stem.size() > kSuffix.size() && stem.compare(stem.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0) {
    stem.resize(stem.size() - kSuffix.size());
  }
  return stem + ending;
}

int export_tables(const ExportOptions& options) {
  const bool is_csv = options.format == "csv";
  const std::string destination =
      options.destination.empty() ? default_destination(options.log, is_csv ? "_csv" : ".h5") : options.destination;
  const io::ExportFormat format = is_csv ? io::ExportFormat::Csv : io::ExportFormat::Hdf5;
  for (const io::ExportedTopic& topic : io::export_log(options.log, format, destination, options.topics)) {
    if (topic.place.empty()) {
      std::cerr << "inslab export: " << topic.topic << " left out: its type " << topic.type << " is not known\n";
      continue;
    }
    std::cout << topic.topic << ": " << topic.rows << " rows in " << (is_csv ? "" : destination + ":/") << topic.place
              << "\n";
    if (topic.unreadable > 0) {
      std::cerr << "inslab export: " << topic.topic << ": " << topic.unreadable << " messages are not " << topic.type
                << " and were left out\n";
    }
  }
  return app::kOk;
}

int export_one_file(const ExportOptions& options, const NamedFormat& format) {
  if (options.topics.size() > 1) {
    std::cerr << "inslab export: --format " << format.name << " writes one topic; " << options.topics.size()
              << " were given\n";
    return app::kBadInput;
  }
  io::FileExportOptions wanted;
  wanted.format = format.format;
  wanted.destination =
      options.destination.empty() ? default_destination(options.log, format.ending) : options.destination;
  if (!options.topics.empty()) wanted.topic = options.topics.front();
  wanted.novatel_imu_type = options.imu_type;
  wanted.novatel_axes = options.axes == "frd" ? io::NovatelAxes::ForwardRightDown : io::NovatelAxes::RightForwardUp;
  const io::ExportedFile file = io::export_file(options.log, wanted);
  std::cout << file.topic << ": " << file.rows << " rows in " << wanted.destination << "\n";
  if (file.left_out > 0) {
    std::cerr << "inslab export: " << file.topic << ": " << file.left_out
              << " samples hold nothing for this format (no interval, fix or solution) and were left out\n";
  }
  if (file.unreadable > 0) {
    std::cerr << "inslab export: " << file.topic << ": " << file.unreadable
              << " messages are not what their type says and were left out\n";
  }
  return app::kOk;
}

int run_export(const ExportOptions& options) {
  try {
    for (const NamedFormat& format : kFileFormats) {
      if (options.format == format.name) return export_one_file(options, format);
    }
    return export_tables(options);
  } catch (const io::ReadError& error) {
    std::cerr << "inslab export: " << error.what() << "\n";
  } catch (const io::WriteError& error) {
    std::cerr << "inslab export: " << error.what() << "\n";
  } catch (const std::invalid_argument& error) {
    std::cerr << "inslab export: " << error.what() << "\n";
  } catch (const std::range_error& error) {
    std::cerr << "inslab export: " << error.what() << "\n";
  }
  return app::kBadInput;
}

std::string known_imu_types() {
  std::string text;
  for (const io::NovatelImuType& type : io::novatel_imu_types()) {
    text += (text.empty() ? "" : ", ") + std::to_string(type.type) + " " + std::string(type.name);
  }
  return text;
}

}  // namespace

void add_export(CLI::App& app, std::function<int()>& action) {
  CLI::App* command = app.add_subcommand("export", "A log in another format: tables of all topics, or a file of one");
  const auto options = std::make_shared<ExportOptions>();
  std::vector<std::string> names{"csv", "hdf5"};
  for (const NamedFormat& format : kFileFormats) names.emplace_back(format.name);
  command->add_option("log", options->log, "an MCAP log of Inslab")->required();
  command
      ->add_option(
          "--format", options->format,
          "csv: a folder of tables; hdf5: one file of tables; nav: truth or solution as 11 columns; imu, gnss: "
          "7 columns; kml: the track on a globe; novatel: RAWIMUSXA lines")
      ->required()
      ->check(app::one_of(names));
  command->add_option("-o,--output", options->destination,
                      "the folder or file; when not given LOG_csv, LOG.h5, LOG.nav, LOG_imu.txt, ... beside the log");
  command
      ->add_option("--topic", options->topics,
                   "only this topic, such as inslab/truth; may be repeated for csv and hdf5")
      ->allow_extra_args(false);
  command->add_option("--imu-type", options->imu_type, "novatel: whose counts: " + known_imu_types())
      ->capture_default_str();
  command->add_option("--axes", options->axes, "novatel: of the counts: right-forward-up or forward-right-down")
      ->check(app::one_of({"rfu", "frd"}))
      ->capture_default_str();
  add_overwrite(*command);
  command->callback([&action, options] { action = [options] { return run_export(*options); }; });
}

}  // namespace inslab::cli
