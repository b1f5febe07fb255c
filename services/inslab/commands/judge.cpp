#include "inslab/services/inslab/commands/judge.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/referee/evidence/run_summary.hpp"
#include "inslab/referee/report/report_files.hpp"
#include "inslab/referee/score/score_log.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/referee/score/score_words.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {

namespace {

/// What the checks and the acceptance come to together; both are in the last line when they are as good.
app::Outcome with_acceptance(const app::Outcome& checks, const std::string& verdict, bool accepted) {
  if (checks.code == app::kOk && accepted) return {app::kOk, checks.reason + "; " + verdict};
  return worse(checks, {accepted ? app::kOk : app::kNotAccepted, verdict});
}

struct JudgeOptions {
  std::string log;
  std::string run_id;
  std::string failure;
  JudgeOutputs outputs;
};

int judge(const JudgeOptions& options) {
  options.outputs.check(options.log);
  if (!options.run_id.empty()) {
    const std::string logged = summarize(io::McapReader(options.log)).identity.run_id;
    if (logged != options.run_id) {
      std::fprintf(stderr, "inslab judge: %s is the log of %s, not of run %s\n", options.log.c_str(),
                   logged.empty() ? "no run" : ("run " + logged).c_str(), options.run_id.c_str());
      return app::kFailed;
    }
  }
  return judge_log(options.log, options.failure.empty() ? std::nullopt : std::optional(options.failure),
                   options.outputs);
}

}  // namespace

void JudgeOutputs::add_to(CLI::App& command) {
  command.add_option("--junit", junit, "write the acceptance as JUnit XML to this file");
  command.add_option("--report", report_folder, "write what `inslab report` says of the log into this folder");
}

void JudgeOutputs::check(const std::string& log_file) const {
  if (!junit.empty()) io::check_output(junit);
  if (report_folder.empty()) return;
  for (const std::string& path : report_paths(log_file, report_folder)) io::check_output(path);
}

int judge_log(const std::string& log_file, const std::optional<std::string>& failure, const JudgeOutputs& outputs) {
  app::Outcome outcome = print_run_summary(log_file, failure);
  const io::McapReader log(log_file);
  const LogSummary summary = summarize(log);
  const LogScore score = score_log(log, summary);
  if (score.scorer.counts().received > 0 || !score.verdicts.empty()) {
    std::fputs(score_words(score, summary).c_str(), stdout);
  }
  if (!outputs.report_folder.empty()) {
    std::printf("\nreport %s.html\n", write_report(log, report_data(log), outputs.report_folder).c_str());
  }
  if (!outputs.junit.empty()) io::write_file(outputs.junit, score::junit_xml(summary.scenario.name, score.verdicts));
  if (!score.verdicts.empty()) outcome = with_acceptance(outcome, verdict_words(score, summary), score.accepted());
  std::printf("%s\n", outcome.words().c_str());
  return outcome.code;
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

}  // namespace inslab::cli
