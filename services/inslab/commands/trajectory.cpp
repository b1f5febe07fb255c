#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/check/trajectory_check.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {

namespace {

int check(const check::TrajectoryCheckOptions& options) {
  const check::TrajectoryChecked checked = check::check_trajectory(options);
  terminal::tell("{}", checked.text);
  return checked.is_good ? host::kOk : host::kFailed;
}

}  // namespace

void add_trajectory(CLI::App& app, std::function<int()>& action) {
  CLI::App* trajectory = app.add_subcommand("trajectory", "Files of rows that a scenario can be driven by");
  trajectory->require_subcommand(1);
  CLI::App* command = trajectory->add_subcommand(
      "check", "Say what such a file is like, what is wrong with it and what repairing it would take");
  auto options = std::make_shared<check::TrajectoryCheckOptions>();
  command
      ->add_option("file", options->file,
                   "text with 11, 7 or 13 columns or with named ones, or a log (docs/formats.md)")
      ->required();
  command->add_option("--columns", options->columns, "names of the columns of a text that does not begin with them");
  command->add_option("--topic", options->topic, "of a log")->capture_default_str();
  command->add_option("--limit", options->limits, "NAME=VALUE as in a scenario's limits; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--repair", options->repair,
                      "write the rows to this file (11 columns), repaired, and report every change");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace inslab::commands
