#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "app/exit_code.hpp"
#include "app/set_members.hpp"
#include "app/shutdown.hpp"
#include "config/error.hpp"
#include "io/error.hpp"
#include "io/output_place.hpp"
#include "services/inslab/commands.hpp"

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
    return app.exit(error) == 0 ? app::kOk : app::kBadInput;
  }
  spdlog::set_default_logger(spdlog::stderr_color_mt("inslab"));
  spdlog::set_pattern("%H:%M:%S.%e %n %^%l%$: %v");
  app::install_signal_handlers();
  try {
    return action();
  } catch (const config::Error& error) {
    std::cerr << "inslab: " << error.what() << "\n";
    return app::kBadInput;
  } catch (const app::PlaceTaken& taken) {
    std::cerr << "inslab: " << taken.what() << "\n";
    return app::kBadInput;
  } catch (const io::OutputRefused& error) {
    std::cerr << "inslab: " << error.what() << "\n";
    return app::kBadInput;
  } catch (const io::ReadError& error) {
    std::cerr << "inslab: " << error.what() << "\n";
    return app::kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "inslab: " << error.what() << "\n";
    return app::kFailed;
  }
}
