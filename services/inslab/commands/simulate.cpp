#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "inslab/bus/service/service_options.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/terminal/tell.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/progress.hpp"
#include "inslab/sim/log_sink.hpp"
#include "inslab/sim/logged_vehicle.hpp"

namespace inslab::commands {

namespace {

struct SimulateOptions {
  std::string scenario;
  std::string unit;
  std::string directory = "runs";
  std::string vehicle_log;
  bool without_log = false;
};

/// Counts and forgets: what an offline run costs without its log.
class CountingSink : public sim::RunSink {
 public:
  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample&, const ImuTruth&) override {}
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}
};

/// Runs to the end; returns the sim time reached.
time::Nanoseconds run_to_end(sim::OfflineRun& run, const scenario::LoadedScenario& loaded) {
  const time::Nanoseconds duration = time::from_seconds(loaded.scenario.duration_s);
  live::Progress progress(loaded.scenario.name, duration);
  constexpr int kStepsBetweenLooks = 4096;
  bool more = true;
  try {
    while (more) {
      for (int i = 0; i < kStepsBetweenLooks && more; ++i) more = run.step();
      progress.show(run.sim_time());
    }
  } catch (const std::domain_error& error) {  // a motion that leaves its domain: when and in which segment, not whose
    throw std::domain_error(loaded.file.string() + ": " + error.what());
  }
  return run.sim_time();
}

int simulate(const SimulateOptions& options) {
  const scenario::LoadedScenario loaded = scenario::load(options.scenario, options.unit);
  std::vector<UsedVehicleState> states = sim::vehicle_states_for(loaded, options.vehicle_log);
  const time::GpsTime start = loaded.start(host::realtime_now());
  const RunId run_id = host::random_run_id();
  const time::Nanoseconds begun = host::monotonic_now();

  std::unique_ptr<sim::LogSink> log;
  CountingSink nothing;
  std::string path;
  if (!options.without_log) {
    std::filesystem::create_directories(options.directory);
    path = (std::filesystem::path(options.directory) / (loaded.scenario.name + ".mcap")).string();
    log = std::make_unique<sim::LogSink>(path, loaded, start);
  }
  sim::OfflineRun run(loaded, start, run_id, log ? static_cast<sim::RunSink&>(*log) : nothing, std::move(states));
  const time::Nanoseconds reached = run_to_end(run, loaded);
  if (log) log->close();

  const double took_s = time::to_seconds(host::monotonic_now() - begun);
  terminal::tell("{}: {:.3f} s of sim time in {:.2f} s: {:.0f} x real time\n", loaded.scenario.name,
                 time::to_seconds(reached), took_s, time::to_seconds(reached) / took_s);
  if (log) terminal::tell("log {} ({:.1f} MB)\n", path, static_cast<double>(log->file_size()) * 1e-6);
  return host::kOk;
}

}  // namespace

void add_simulate(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand(kSimulate.name, kSimulate.purpose);
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  service::add_unit_option(*command, options->unit,
                           "the vehicle's name: it chooses the random streams, as in a live run");
  command->add_option("-o,--output", options->directory, "directory for the log NAME.mcap")->capture_default_str();
  command->add_option("--vehicle", options->vehicle_log, "log of a live run whose vehicle states are used again");
  command->add_flag("--no-log", options->without_log, "write no log");
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return simulate(*options); }; });
}

}  // namespace inslab::commands
