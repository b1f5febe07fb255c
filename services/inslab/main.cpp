#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>

#include "inslab/bus/service/set_members.hpp"
#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/output_place.hpp"
#include "inslab/foundation/files/unfinished.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/finite_numbers.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/host/usage_error.hpp"
#include "inslab/foundation/text/shown.hpp"
#include "inslab/services/inslab/commands/command_line.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace {

void say(const std::string& what) { std::cerr << "inslab: " << inslab::text::shown_lines(what) << "\n"; }

int carried_out(const std::function<int()>& action) {
  using namespace inslab;
  try {
    return action();
  } catch (const json::Error& error) {
    say(error.what());
    return host::kBadInput;
  } catch (const host::UsageError& error) {
    say(error.what());
    return host::kBadInput;
  } catch (const service::PlaceTaken& taken) {
    say(taken.what());
    return host::kBadInput;
  } catch (const files::OutputRefused& error) {
    say(error.what());
    return host::kBadInput;
  } catch (const files::ReadError& error) {
    say(error.what());
    return host::kBadInput;
  } catch (const std::bad_alloc&) {
    say("there is not enough memory for this input or its result");
    return host::kFailed;
  } catch (const std::exception& error) {
    say(error.what());
    return host::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace inslab;
  CLI::App app("Hardware-in-the-loop GNSS/INS simulator", "inslab");
  app.require_subcommand(1);
  app.set_version_flag("--version", INSLAB_VERSION);
  std::function<int()> action;
  commands::add_commands(app, action);
  host::expect_finite_numbers(app);
  files::set_output_rule(files::OutputRule::KeepResults);  // a command's --overwrite loosens it
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return commands::answer(app, error);
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("inslab"));
  spdlog::set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
  host::install_signal_handlers();
  host::CommandEnding ending(commands::command_words(app), files::discard_unfinished);
  return ending.finished(carried_out(action));
}
