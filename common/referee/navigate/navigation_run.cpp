#include "inslab/referee/navigate/navigation_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/models/navigation/app_setup.hpp"
#include "inslab/models/navigation/parameters_file.hpp"
#include "inslab/models/navigation/refusals.hpp"
#include "inslab/referee/navigate/result_files.hpp"
#include "inslab/referee/score/score_text.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::navigate {
namespace {

/// A file of parameters; else what the scenario says its app is told, or what matches its sensors.
navigation::AppSetup setup_of(const NavigateOptions& options) {
  navigation::AppSetup setup;
  setup.app.imu = options.imu_number;
  setup.app.gnss = options.gnss_number;
  if (!options.scenario.empty()) {
    const scenario::LoadedScenario loaded = scenario::load(options.scenario, {}, scenario::TrajectoryRows::LeaveOut);
    scenario::ReferenceNav app = loaded.scenario.reference_nav.value_or(scenario::ReferenceNav{});
    app.imu = options.imu_number;
    app.gnss = options.gnss_number;
    setup = navigation::setup_for(loaded, app);
  }
  if (!options.parameters.empty()) {
    setup.parameters = navigation::read_parameters(options.parameters);
    setup.left_out.clear();
  }
  return setup;
}

/// What of the sensors' errors those parameters do not tell the filter.
std::string left_out_of(const navigation::AppSetup& setup) {
  if (setup.left_out.empty()) return "";
  return fmt::format("left out of the filter's parameters: {}\n", fmt::join(setup.left_out, ", "));
}

std::string why_it_never_began(const navigation::NavigationFilter& filter, const navigation::Refusals& refusals) {
  const auto& counts = filter.counts();
  std::string why = "the filter never began: ";
  const std::string refusal = refusals.words();
  why += refusal.empty() ? "no fix came that it could begin at while it was aligned" : refusal;
  why += "; in motion: " + filter.motion_refusal();
  return why + fmt::format(" (fixes not used {}, too old {}; IMU samples not valid {}, gaps {})", counts.fixes_not_used,
                           counts.fixes_too_old, counts.imu_not_valid, counts.imu_gaps);
}

Navigated finished(ResultFiles& files, const NavigateOptions& options, const navigation::NavigationFilter& filter,
                   const navigation::Refusals& refusals) {
  Navigated done;
  done.solutions = files.rows();
  if (done.solutions == 0) {
    done.why_none = why_it_never_began(filter, refusals);
    return done;  // and no files without a row
  }
  files.close();
  const auto& counts = filter.counts();
  done.text = fmt::format("{} solutions in {}.nav, standard deviations in {}_sigmas.txt\n", files.rows(),
                          options.output, options.output);
  done.text += fmt::format(
      "fixes not used {}, too old {}; IMU samples not valid {}, out of order {}, gaps {}; begun anew {} times\n",
      counts.fixes_not_used, counts.fixes_too_old, counts.imu_not_valid, counts.imu_out_of_order, counts.imu_gaps,
      counts.restarts);
  return done;
}

}  // namespace

Navigated navigate_log(const NavigateOptions& options) {
  const mcap::McapReader log(options.log);
  const navigation::AppSetup setup = setup_of(options);
  OfflineFilter filter = filter_with_streams_of(log, setup);
  if (options.start_at_truth) filter.start_at(first_true_state(log, options.imu_number));
  log::needed_channels_of(log, catalog::stream_topic<ImuSample>(options.imu_number),
                          catalog::WireType<ImuSample>::name);
  ResultFiles files(options.output);  // from here on nothing is refused
  navigation::Refusals refusals;
  const score::LogScore scored = score::score_app(
      log, evidence::summarize(log), {options.imu_number, options.gnss_number, [&](const ImuSample& sample) {
                                        auto solution = filter.take(sample);
                                        refusals.note(filter.filter().alignment_refusal());
                                        if (solution) files.write(*solution);
                                        return solution;
                                      }});
  Navigated done = finished(files, options, filter.filter(), refusals);
  done.text = left_out_of(setup) + done.text;
  if (scored.scorer.counts().scored > 0) done.score = score::score_text(scored.scorer, {});
  return done;
}

Navigated navigate_files(const NavigateOptions& options) {
  const navigation::AppSetup setup = setup_of(options);
  OfflineFilter filter = filter_with_fixes_of(options.gnss_file, options.imu_file, setup);
  for_each_text_sample(options.imu_file, options.gps_week,
                       [](const ImuSample&) {});  // a bad line leaves no half result
  ResultFiles files(options.output);
  navigation::Refusals refusals;
  for_each_text_sample(options.imu_file, options.gps_week, [&](const ImuSample& sample) {
    if (const auto solution = filter.take(sample)) files.write(*solution);
    refusals.note(filter.filter().alignment_refusal());
  });
  Navigated done = finished(files, options, filter.filter(), refusals);
  done.text = left_out_of(setup) + done.text;
  return done;
}

}  // namespace inslab::navigate
