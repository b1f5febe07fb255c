#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>

#include "app/exit_code.hpp"
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
  cli::add_run(app, action);
  cli::add_summary(app, action);
  cli::add_report(app, action);
  cli::add_soak(app, action);
  cli::add_simulate(app, action);
  cli::add_status(app, action);
  cli::add_swap(app, action);
  cli::add_schedule(app, action);
  cli::add_control(app, action);
  cli::add_topics(app, action);
  cli::add_doctor(app, action);
  cli::add_check(app, action);
  cli::add_info(app, action);
  cli::add_export(app, action);
  cli::add_trajectory(app, action);
  cli::add_plot(app, action);
  cli::add_reference(app, action);
  cli::add_navigate(app, action);
  cli::add_montecarlo(app, action);
  cli::add_align(app, action);
  cli::add_allan(app, action);
  cli::add_predict(app, action);
  cli::add_profile(app, action);
  cli::add_verify(app, action);
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
