#include "inslab/services/inslab/commands/judge.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/report/report_files.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

struct JudgeOptions {
  std::string log;
  std::string run_id;
  std::string failure;
  JudgeOutputs outputs;
};

int judge(const JudgeOptions& options) {
  options.outputs.check(options.log);
  return judge_log(options.log, options.failure.empty() ? std::nullopt : std::optional(options.failure),
                   options.outputs, options.run_id);
}

}  // namespace

void JudgeOutputs::add_to(CLI::App& command) {
  command.add_option("--junit", junit, "write the acceptance as JUnit XML to this file");
  command.add_option("--report", report_folder, "write what `inslab report` says of the log into this folder");
}

void JudgeOutputs::check(const std::string& log_file) const {
  if (!junit.empty()) files::check_output(junit);
  if (report_folder.empty()) return;
  for (const std::string& path : report::report_paths(log_file, report_folder)) files::check_output(path);
}

int judge_log(const std::string& log_file, const std::optional<std::string>& failure, const JudgeOutputs& outputs,
              const std::string& run_id) {
  const report::ReportData data =
      report::report_data(mcap::McapReader(log_file),
                          outputs.report_folder.empty() ? report::ReportDepth::Verdict : report::ReportDepth::Page);
  const std::string& logged = data.summary.identity.run_id;
  if (!run_id.empty() && logged != run_id) {
    terminal::tell(stderr, "inslab judge: {} is the log of {}, not of run {}\n", log_file,
                   logged.empty() ? "no run" : "run " + logged, run_id);
    return host::kFailed;
  }
  const report::Judgement judgement = report::judgement_of(data, failure);
  terminal::tell("{}", judgement.text);
  if (!outputs.report_folder.empty())
    terminal::tell("\nreport {}.html\n", report::write_report(data, outputs.report_folder));
  if (!outputs.junit.empty()) {
    files::write_file(outputs.junit, score::junit_xml(data.summary.scenario.name, data.score.verdicts));
  }
  terminal::tell("{}\n", judgement.outcome.words());
  return judgement.outcome.code;
}

void add_judge(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<JudgeOptions>();
  CLI::App* command = app.add_subcommand(
      "judge",
      "Say of a log what `inslab run` says at its end: the checks, the score, the acceptance; its exit code too");
  command->add_option("log", options->log, "log (MCAP)")->required();
  command->add_option("--run", options->run_id, "the id of the run that it must be of");
  command->add_option("--failure", options->failure, "what went wrong where the log does not show it");
  options->outputs.add_to(*command);
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return judge(*options); }; });
}

}  // namespace inslab::commands
