#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace inslab::commands {

/// What is written of a verdict besides the log; empty: not that.
struct JudgeOutputs {
  std::string junit;
  std::string report_folder;

  void add_to(CLI::App& command);
  /// Throws files::OutputRefused when something that is there already stands in the way of what is written of this log.
  void check(const std::string& log_file) const;
};

/// Says what a run came to, from its log: the checks, the score of the app under test, the scenario's acceptance, and
/// all of it in the last line. `failure` is what the one who ran it saw go wrong, if anything; the log must be of the
/// run with `run_id` where that is not empty. Returns the exit code. Throws files::ReadError, json::Error.
int judge_log(const std::string& log_file, const std::optional<std::string>& failure, const JudgeOutputs& outputs,
              const std::string& run_id = "");

}  // namespace inslab::commands
