#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/one_of.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/referee/check/file_check.hpp"
#include "inslab/scenario/document_kind.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/progress.hpp"

namespace inslab::commands {

namespace {

int check(check::CheckOptions options) {
  std::optional<live::Progress> progress;  // of a look that takes long
  const time::Nanoseconds begun = host::monotonic_now();
  options.progress = [&](const std::string& name, double span_s, time::Nanoseconds sim_time) {
    if (!progress && host::monotonic_now() - begun > std::chrono::seconds(2)) {
      progress.emplace(name + ": looking ahead", time::from_seconds(span_s));
    }
    if (progress) progress->show(sim_time);
  };
  const check::FileCheck checked = check::check_file(options);
  progress.reset();
  terminal::tell("{}", checked.text);
  return checked.is_good ? host::kOk : host::kFailed;
}

}  // namespace

void add_check(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<check::CheckOptions>();
  CLI::App* command = app.add_subcommand(
      "check", "Recognise a file by its content, read it and all it names; say what is wrong, or what is in it");
  command
      ->add_option(
          "file", options->file,
          "scenario, profile, schedule, filter's parameters (JSON), log (MCAP), trajectory or recording (text)")
      ->required();
  std::vector<std::string> kinds{"scenario", "navigation"};
  for (const std::string& word : scenario::profile_kind_words()) kinds.push_back(word);
  command->add_option("--kind", options->kind, "what the file must be; absent: what it is")->check(host::one_of(kinds));
  command->add_option("--sensor", options->sensor_kind, "for a profile: the kind of sensor it goes to")
      ->check(host::one_of(enum_words<SensorKind>()));
  command->add_flag("--files", options->lists_files, "for a scenario: print only the files that it takes, one a line");
  command->callback([options, &action] { action = [options] { return check(*options); }; });
}

}  // namespace inslab::commands
