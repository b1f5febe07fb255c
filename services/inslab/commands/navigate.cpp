#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/models/navigation/refusals.hpp"
#include "inslab/referee/evidence/tell.hpp"
#include "inslab/referee/navigate/offline_filter.hpp"
#include "inslab/referee/navigate/result_files.hpp"
#include "inslab/referee/score/score_log.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/scenario/load.hpp"
#include "inslab/services/inslab/commands/commands.hpp"

namespace inslab::cli {
namespace {

struct NavigateOptions {
  std::string log;
  std::string imu_file;
  std::string gnss_file;
  std::string parameters;
  std::string scenario;
  std::string output;
  std::uint32_t imu_number = 0;
  std::uint32_t gnss_number = 0;
  std::uint32_t gps_week = 0;
  bool start_at_truth = false;
};

/// A file of parameters; else what the scenario says its app is told, or what matches its sensors.
reference_nav::AppSetup setup_of(const NavigateOptions& options) {
  reference_nav::AppSetup setup;
  if (!options.scenario.empty()) {
    const scenario::LoadedScenario loaded = scenario::load(options.scenario, {}, scenario::TrajectoryRows::LeaveOut);
    scenario::ReferenceNav app = loaded.scenario.reference_nav.value_or(scenario::ReferenceNav{});
    app.imu = options.imu_number;
    app.gnss = options.gnss_number;
    setup = reference_nav::setup_for(loaded, app);
  }
  if (!options.parameters.empty()) {
    setup.parameters = reference_nav::read_parameters(options.parameters);
    setup.left_out.clear();
  }
  if (!setup.left_out.empty()) tell("left out of the filter's parameters: {}\n", fmt::join(setup.left_out, ", "));
  return setup;
}

std::string why_it_never_began(const reference_nav::NavigationFilter& filter, const reference_nav::Refusals& refusals) {
  const auto& counts = filter.counts();
  std::string why = "the filter never began: ";
  const std::string refusal = refusals.words();
  why += refusal.empty() ? "no fix came that it could begin at while it was aligned" : refusal;
  why += "; in motion: " + filter.motion_refusal();
  return why + fmt::format(" (fixes not used {}, too old {}; IMU samples not valid {}, gaps {})", counts.fixes_not_used,
                           counts.fixes_too_old, counts.imu_not_valid, counts.imu_gaps);
}

int finish(ResultFiles& files, const NavigateOptions& options, const reference_nav::NavigationFilter& filter,
           const reference_nav::Refusals& refusals) {
  if (files.rows() == 0) {
    std::cerr << "inslab navigate: no solution: " << why_it_never_began(filter, refusals) << "\n";
    return app::kFailed;  // and no files without a row
  }
  files.close();
  const auto& counts = filter.counts();
  tell("{} solutions in {}.nav, standard deviations in {}_sigmas.txt\n", files.rows(), options.output, options.output);
  tell("fixes not used {}, too old {}; IMU samples not valid {}, out of order {}, gaps {}; begun anew {} times\n",
       counts.fixes_not_used, counts.fixes_too_old, counts.imu_not_valid, counts.imu_out_of_order, counts.imu_gaps,
       counts.restarts);
  return app::kOk;
}

int navigate_log(const NavigateOptions& options) {
  const io::McapReader log(options.log);
  OfflineFilter filter = filter_with_fixes_of(log, options.gnss_number, setup_of(options));
  if (options.start_at_truth) filter.start_at(first_true_state(log, options.imu_number));
  io::needed_channels_of(log, catalog::stream_topic<ImuSample>(options.imu_number), wire::WireType<ImuSample>::name);
  ResultFiles files(options.output);  // from here on nothing is refused
  reference_nav::Refusals refusals;
  const LogScore score =
      score_app(log, summarize(log), {options.imu_number, options.gnss_number, [&](const ImuSample& sample) {
                                        auto solution = filter.take(sample);
                                        refusals.note(filter.filter().alignment_refusal());
                                        if (solution) files.write(*solution);
                                        return solution;
                                      }});
  const int code = finish(files, options, filter.filter(), refusals);
  if (score.scorer.counts().scored > 0) tell("{}", score::score_text(score.scorer, {}));
  return code;
}

int navigate_files(const NavigateOptions& options) {
  OfflineFilter filter = filter_with_fixes_of(options.gnss_file, options.imu_file, setup_of(options));
  for_each_text_sample(options.imu_file, options.gps_week,
                       [](const ImuSample&) {});  // a bad line leaves no half result
  ResultFiles files(options.output);
  reference_nav::Refusals refusals;
  for_each_text_sample(options.imu_file, options.gps_week, [&](const ImuSample& sample) {
    if (const auto solution = filter.take(sample)) files.write(*solution);
    refusals.note(filter.filter().alignment_refusal());
  });
  return finish(files, options, filter.filter(), refusals);
}

int navigate(const NavigateOptions& options) {
  if (options.log.empty() && options.imu_file.empty()) {
    std::cerr << "inslab navigate: give a log, or --imu and --gnss\n";
    return app::kBadInput;
  }
  if (options.parameters.empty() && options.scenario.empty()) {
    std::cerr << "inslab navigate: give the filter's --parameters, or the --scenario whose sensors it is to match\n";
    return app::kBadInput;
  }
  return options.log.empty() ? navigate_files(options) : navigate_log(options);
}

}  // namespace

void add_navigate(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<NavigateOptions>();
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
  command->add_option("--week", options->gps_week, "of text files, which do not say it")->capture_default_str();
  command->add_flag("--start-at-truth", options->start_at_truth, "of a log: begin at the IMU's true state")->needs(log);
  command->add_option("-o,--output", options->output, "writes OUTPUT.nav and OUTPUT_sigmas.txt")->required();
  add_overwrite(*command);
  command->callback([&action, options] { action = [options] { return navigate(*options); }; });
}

}  // namespace inslab::cli
