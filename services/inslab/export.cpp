#include <CLI/CLI.hpp>
#include <iostream>
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
  std::string format;
  std::string destination;
  std::vector<std::string> topics;

  bool is_csv() const { return format == "csv"; }
};

/// run.mcap gives run_csv or run.h5, beside the log.
std::string default_destination(const ExportOptions& options) {
  constexpr std::string_view kSuffix = ".mcap";
  std::string stem = options.log;
  if (stem.size() > kSuffix.size() && stem.compare(stem.size() - kSuffix.size(), kSuffix.size(), kSuffix) == 0) {
    stem.resize(stem.size() - kSuffix.size());
  }
  return stem + (options.is_csv() ? "_csv" : ".h5");
}

int run_export(const ExportOptions& options) {
  const std::string destination = options.destination.empty() ? default_destination(options) : options.destination;
  const io::ExportFormat format = options.is_csv() ? io::ExportFormat::Csv : io::ExportFormat::Hdf5;
  try {
    for (const io::ExportedTopic& topic : io::export_log(options.log, format, destination, options.topics)) {
      if (topic.place.empty()) {
        std::cerr << "inslab export: " << topic.topic << " left out: its type " << topic.type << " is not known\n";
        continue;
      }
      std::cout << topic.topic << ": " << topic.rows << " rows in " << (options.is_csv() ? "" : destination + ":/")
                << topic.place << "\n";
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
  command->add_option("log", options->log, "an MCAP log of Inslab")->required();
  command->add_option("--format", options->format, "csv: a folder of files; hdf5: one file")
      ->required()
      ->check(CLI::IsMember({"csv", "hdf5"}));
  command->add_option("-o,--output", options->destination, "the folder or file; LOG_csv or LOG.h5 when not given");
  command->add_option("--topic", options->topics, "only this topic, such as inslab/truth; may be repeated")
      ->allow_extra_args(false);
  command->callback([&action, options] { action = [options] { return run_export(*options); }; });
}

}  // namespace inslab::cli
