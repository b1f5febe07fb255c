#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <new>

#include "app/command_ending.hpp"
#include "app/exit_code.hpp"
#include "app/set_members.hpp"
#include "app/shutdown.hpp"
#include "config/error.hpp"
#include "io/error.hpp"
#include "io/output_place.hpp"
#include "io/unfinished.hpp"
#include "services/inslab/command_line.hpp"
#include "services/inslab/commands.hpp"
#include "text/shown.hpp"

namespace {

void say(const std::string& what) { std::cerr << "inslab: " << inslab::text::shown_lines(what) << "\n"; }

int carried_out(const std::function<int()>& action) {
  using namespace inslab;
  try {
    return action();
  } catch (const config::Error& error) {
    say(error.what());
    return app::kBadInput;
  } catch (const app::PlaceTaken& taken) {
    say(taken.what());
    return app::kBadInput;
  } catch (const io::OutputRefused& error) {
    say(error.what());
    return app::kBadInput;
  } catch (const io::ReadError& error) {
    say(error.what());
    return app::kBadInput;
  } catch (const std::bad_alloc&) {
    say("there is not enough memory for this input or its result");
    return app::kFailed;
  } catch (const std::exception& error) {
    say(error.what());
    return app::kFailed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  using namespace inslab;
  CLI::App app("Hardware-in-the-loop GNSS/INS simulator", "inslab");
  app.require_subcommand(1);
  app.set_version_flag("--version", INSLAB_VERSION);
  std::function<int()> action;
  cli::add_commands(app, action);
  io::set_output_rule(io::OutputRule::KeepResults);  // a command's --overwrite loosens it
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return cli::answer(app, error);
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("inslab"));
  spdlog::set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
  app::install_signal_handlers();
  app::CommandEnding ending(cli::command_words(app), io::discard_unfinished);
  return ending.finished(carried_out(action));
}
