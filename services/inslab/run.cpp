#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include "app/exit_code.hpp"
#include "app/host.hpp"
#include "app/service.hpp"
#include "app/service_names.hpp"
#include "app/shutdown.hpp"
#include "services/inslab/child_processes.hpp"
#include "services/inslab/commands.hpp"
#include "services/inslab/progress.hpp"
#include "services/inslab/run_client.hpp"
#include "services/inslab/run_summary.hpp"

namespace inslab::cli {

using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

struct RunOptions {
  std::string scenario;
  std::string log_file;
  app::NetworkOptions network;
  app::ClockOptions clock;
  bool verbose = false;
};

/// A run from start to summary.
class LiveRun {
 public:
  LiveRun(const RunOptions& options, const scenario::LoadedScenario& loaded)
      : options_(options),
        loaded_(loaded),
        participant_(app::participant_options(options.network, "inslab-run")),
        client_(participant_),
        lockstep_(options.clock.mode.empty() ? loaded.scenario.clock.mode == ClockMode::Lockstep
                                             : options.clock.mode == "lockstep"),
        holds_the_start_(lockstep_ && !loaded.swaps.empty()) {}

  /// Starts one process for each service of the scenario.
  void start_services() {
    std::vector<std::string> common{"--scenario", options_.scenario, "--log-level", options_.verbose ? "info" : "warn"};
    const std::vector<std::string> network = options_.network.as_arguments();
    common.insert(common.end(), network.begin(), network.end());
    const auto with = [&common](std::initializer_list<std::string> more) {
      std::vector<std::string> arguments = common;
      arguments.insert(arguments.end(), more);
      return arguments;
    };
    children_.start(app::kTruthLogger, with({"--log", options_.log_file}));
    for (const auto& imu : loaded_.imus) {
      children_.start(app::kImuInjector, with({"--sensor", std::to_string(imu.number)}));
    }
    for (const auto& gnss : loaded_.gnss) {
      children_.start(app::kGnssEmulator, with({"--sensor", std::to_string(gnss.number)}));
    }
    app::ClockOptions clock = options_.clock;
    clock.paused = clock.paused || holds_the_start_;
    const std::vector<std::string> arguments = clock.as_arguments();
    common.insert(common.end(), arguments.begin(), arguments.end());
    children_.start(app::kTrajectoryServer, common);
  }

  /// Sends the scheduled swaps while the run goes on; returns when every process has ended or something went wrong.
  void follow() {
    Progress progress(loaded_.scenario.name, time::from_seconds(loaded_.scenario.duration_s));
    bool told_to_stop = false;
    while (!children_.all_ended()) {
      children_.poll();
      if (!told_to_stop && client_.status() && in_progress(*client_.status())) restart_killed(progress);
      const auto status = client_.status();
      if (status) {
        progress.show(time::Nanoseconds(status->sim_time_ns));
        send_due_swaps(*status);
      }
      if (app::shutdown_requested() && !told_to_stop) {
        told_to_stop = true;
        stop_deadline_ = app::monotonic_now() + seconds(10);
        if (!client_.connected() || !client_.send({1, CommandKind::Stop, 0.0})) children_.terminate();
      }
      if (!told_to_stop && children_.failure() && (!status || status->state == RunState::Waiting)) {
        told_to_stop = true;  // the barrier will not open without it
        stop_deadline_ = app::monotonic_now() + seconds(10);
        children_.terminate();
      }
      if (children_.has_ended(app::kTrajectoryServer) && !stop_deadline_) {
        stop_deadline_ = app::monotonic_now() + seconds(15);
        // Without the clock nobody ends by itself.
        if (children_.failure() && !told_to_stop) children_.terminate();
      }
      if (stop_deadline_ && app::monotonic_now() > *stop_deadline_) return;
      std::this_thread::sleep_for(milliseconds(20));
    }
  }

  std::optional<std::string> failure() const {
    if (app::shutdown_requested()) return "stopped by a signal";
    if (!children_.all_ended()) return "a service did not end";
    if (next_swap_ < loaded_.swaps.size()) return "the run ended before all swaps were sent";
    return children_.failure();
  }

 private:
  static bool in_progress(const SimStatus& status) {
    return status.state == RunState::Running || status.state == RunState::Paused;
  }

  /// A service that was killed goes on from its checkpoint, but not the one that is the clock.
  void restart_killed(Progress& progress) {
    for (const std::string& line : children_.restart_killed_except(app::kTrajectoryServer)) progress.say(line);
  }

  /// A request goes out a second before it takes effect: ample for the journal, and still while the run goes on. In
  /// lockstep a second holds minutes of sim time, so all of them go out while the run is still held at its start.
  void send_due_swaps(const SimStatus& status) {
    const auto lead_ns = static_cast<std::int64_t>(1e9 * std::max(1.0, status.rate));
    while (next_swap_ < loaded_.swaps.size() && client_.connected()) {
      const AnyProfile& request = loaded_.swaps[next_swap_];
      const bool early = !lockstep_ && request_of(request).apply_at_ns > status.sim_time_ns + lead_ns;
      if (early || !client_.send(request)) return;
      ++next_swap_;
    }
    const bool journalled = status.journal_entries >= loaded_.swaps.size();
    if (holds_the_start_ && !released_ && !options_.clock.paused && journalled) {
      released_ = client_.send({1, CommandKind::Resume, 0.0});
    }
  }

  const RunOptions& options_;
  const scenario::LoadedScenario& loaded_;
  dds::Participant participant_;
  RunClient client_;
  ChildProcesses children_;
  bool lockstep_;
  bool holds_the_start_;  ///< until every scheduled swap is in the journal
  bool released_ = false;
  std::size_t next_swap_ = 0;
  std::optional<time::Nanoseconds> stop_deadline_;
};

int run(RunOptions options) {
  const scenario::LoadedScenario loaded = scenario::load(options.scenario);
  if (options.log_file.empty()) {
    options.log_file = "runs/" + loaded.scenario.name + "-" + app::utc_text(app::realtime_now()) + ".mcap";
  }
  std::optional<std::string> failure;
  {
    LiveRun live(options, loaded);
    live.start_services();
    live.follow();
    failure = live.failure();
  }
  if (!std::filesystem::exists(options.log_file)) {
    std::fprintf(stderr, "inslab run: %s; there is no log\n", failure ? failure->c_str() : "the logger wrote nothing");
    return app::kFailed;
  }
  const bool good = print_run_summary(options.log_file, failure);
  return good ? app::kOk : app::kFailed;
}

}  // namespace

void add_run(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      app.add_subcommand("run", "Run a scenario live: one process for each service, real DDS, real time");
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_option("--log", options->log_file, "file to write; default runs/NAME-TIME.mcap");
  command->add_flag("-v,--verbose", options->verbose, "show what the services say");
  options->network.add_to(*command);
  options->clock.add_to(*command);
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace inslab::cli
