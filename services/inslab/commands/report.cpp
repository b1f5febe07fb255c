#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "inslab/data/json/json_text.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/report/report_files.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

struct ReportOptions {
  std::string log;
  std::string directory;
  std::string junit;
  bool json = false;
};

int report(const ReportOptions& options) {
  if (!options.junit.empty()) files::check_output(options.junit);
  const mcap::McapReader log(options.log);
  const report::ReportData data =
      report::report_data(log, options.directory.empty() ? report::ReportDepth::Figures : report::ReportDepth::Page);
  terminal::tell("{}", options.json ? json::json_text(report::report_json(data)) : report::report_text(data));
  if (!options.junit.empty()) {
    files::write_file(options.junit, score::junit_xml(data.summary.scenario.name, data.score.verdicts));
  }
  if (!options.directory.empty()) {
    const std::string stem = report::write_report(data, options.directory);
    if (!options.json) terminal::tell("\n{0}.txt, {0}.json and {0}.html written\n", stem);
  }
  return data.score.accepted() ? host::kOk : host::kNotAccepted;
}

}  // namespace

void add_report(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand(
      "report", "Score the navigation app of a log; exit code 4 when the scenario's acceptance fails");
  command->add_option("log", options->log, "log (MCAP)")->required();
  command->add_option("-o,--output", options->directory,
                      "folder for the figures as text and JSON and for one HTML page with pictures");
  command->add_flag("--json", options->json, "print JSON");
  command->add_option("--junit", options->junit, "write the acceptance as JUnit XML to this file");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return report(*options); }; });
}

}  // namespace inslab::commands
