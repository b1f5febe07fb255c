#include <CLI/CLI.hpp>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/log_export.hpp"
#include "services/inslab/commands.hpp"

namespace inslab::cli {
namespace {

struct ExportOptions {
  std::string log;
  io::ExportFormat format = io::ExportFormat::Csv;
  std::string destination;
  std::vector<std::string> topics;
};

/// run.mcap gives run_csv or run.h5, beside the log.
std::string default_destination(const ExportOptions& options) {
  constexpr std::string_view kSuffix = ".mcap";
  std::string stem = options.log;
  if (stem.size() > kSuffix.size() && stem.compare(stem.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0) {
    stem.resize(stem.size() - kSuffix.size());
  }
  return stem + (options.format == io::ExportFormat::Csv ? "_csv" : ".h5");
}

int run_export(const ExportOptions& options) {
  const std::string destination = options.destination.empty() ? default_destination(options) : options.destination;
  try {
    for (const io::ExportedTopic& topic : io::export_log(options.log, options.format, destination, options.topics)) {
      if (topic.place.empty()) {
        std::cerr << "inslab export: " << topic.topic << " left out: its type " << topic.type << " is not known\n";
        continue;
      }
      std::cout << topic.topic << ": " << topic.rows << " rows in "
                << (options.format == io::ExportFormat::Csv ? "" : destination + ":/") << topic.place << "\n";
      if (topic.unreadable > 0) {
        std::cerr << "inslab export: " << topic.topic << ": " << topic.unreadable << " messages are not " << topic.type
                  << " and were left out\n";
      }
    }
    return 0;
  } catch (const io::ReadError& error) {
    std::cerr << "inslab export: " << error.what() << "\n";
  } catch (const io::WriteError& error) {
    std::cerr << "inslab export: " << error.what() << "\n";
  }
  return 2;
}

}  // namespace

void add_export(CLI::App& app, std::function<int()>& action) {
  CLI::App* command = app.add_subcommand("export", "A log as CSV or HDF5 tables, one for each topic");
  const auto options = std::make_shared<ExportOptions>();
  const std::map<std::string, io::ExportFormat> formats{{"csv", io::ExportFormat::Csv},
                                                        {"hdf5", io::ExportFormat::Hdf5}};
  command->add_option("log", options->log, "an MCAP log of Inslab")->required();
  command->add_option("--format", options->format, "csv: a folder of files; hdf5: one file")
      ->required()
      ->transform(CLI::CheckedTransformer(formats));
  command->add_option("-o,--output", options->destination, "the folder or file; LOG_csv or LOG.h5 when not given");
  command->add_option("--topic", options->topics, "only this topic, such as inslab/truth; may be repeated")
      ->allow_extra_args(false);
  command->callback([&action, options] { action = [options] { return run_export(*options); }; });
}

}  // namespace inslab::cli
