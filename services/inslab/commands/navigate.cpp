#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/referee/navigate/navigation_run.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::commands {
namespace {

int navigate(const navigate::NavigateOptions& options) {
  if (options.log.empty() && options.imu_file.empty()) {
    terminal::tell(stderr, "inslab navigate: give a log, or --imu and --gnss\n");
    return host::kBadInput;
  }
  if (options.parameters.empty() && options.scenario.empty()) {
    terminal::tell(stderr,
                   "inslab navigate: give the filter's --parameters, or the --scenario whose sensors it is to match\n");
    return host::kBadInput;
  }
  const navigate::Navigated done =
      options.log.empty() ? navigate::navigate_files(options) : navigate::navigate_log(options);
  if (done.solutions == 0) terminal::tell(stderr, "inslab navigate: no solution: {}\n", done.why_none);
  terminal::tell("{}{}", done.text, done.score);
  return done.solutions > 0 ? host::kOk : host::kFailed;
}

}  // namespace

void add_navigate(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<navigate::NavigateOptions>();
  CLI::App* command = app.add_subcommand(kNavigate.name, kNavigate.purpose);
  CLI::Option* log = command->add_option("log", options->log, "an MCAP log of Inslab");
  CLI::Option* imu = command->add_option("--imu", options->imu_file,
                                         "7 columns: seconds of week, dtheta rad, dv m/s, forward-right-down");
  CLI::Option* gnss =
      command->add_option("--gnss", options->gnss_file, "7 columns: seconds of week, lat lon deg, height m, sigmas m");
  imu->needs(gnss)->excludes(log);
  gnss->needs(imu)->excludes(log);
  command->add_option("--parameters", options->parameters, "what the filter believes (config/nav)");
  command->add_option(
      "--scenario", options->scenario,
      "what this scenario's app is told, or parameters that match its sensors; with --parameters its gravity");
  command->add_option("--imu-number", options->imu_number, "of a log: inslab/imu/N")->capture_default_str();
  command->add_option("--gnss-number", options->gnss_number, "of a log: inslab/gnss/N")->capture_default_str();
  command->add_option("--week", options->gps_week, "of text files, which do not say it")
      ->check(CLI::Range(0u, time::kLastGpsWeek))
      ->capture_default_str();
  command->add_flag("--start-at-truth", options->start_at_truth, "of a log: begin at the IMU's true state")->needs(log);
  command->add_option("-o,--output", options->output, "writes OUTPUT.nav and OUTPUT_sigmas.txt")->required();
  add_overwrite(*command);
  command->callback([&action, options] { action = [options] { return navigate(*options); }; });
}

}  // namespace inslab::commands
