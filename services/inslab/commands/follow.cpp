#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <thread>

#include "inslab/bus/client/run_client.hpp"
#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/command_ending.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/progress.hpp"

namespace inslab::cli {

namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct FollowOptions {
  std::string scenario;
  double timeout_s = 60.0;
  bool release = false;
  app::NetworkOptions network;
};

/// Goes along with a run that others started, from before its first sample to its end.
class Follower {
 public:
  Follower(const FollowOptions& options, const scenario::LoadedScenario& loaded)
      : options_(options),
        swaps_(loaded.swaps),
        participant_(app::participant_options(options.network, "inslab-follow")),
        client_(participant_),
        progress_(loaded.scenario.name, time::from_seconds(loaded.scenario.duration_s)) {}

  /// Returns the exit code.
  int run() {
    heard_at_ = begun_at_ = app::monotonic_now();
    while (!app::shutdown_requested()) {
      const auto status = client_.status();
      if (const auto why = silence(status)) return failed(*why);
      if (const std::string why = client_.other_run(); !why.empty()) return failed(why);
      if (status) {
        say_whose_it_is(*status);
        say_when_it_begins(*status);
        if (status->state != RunState::Waiting) progress_.show(time::Nanoseconds(status->sim_time_ns));
        if (has_ended(status->state)) {
          say("ends");
          return end(*status);
        }
        send_swaps();
        release(*status);
      }
      std::this_thread::sleep_for(milliseconds(20));
    }
    return failed("stopped by a signal; the set goes on");
  }

 private:
  /// For whoever waits for it: at once, though it may go into a pipe.
  static void say(const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  }

  int failed(const std::string& why) const {
    progress_.say("inslab follow: " + why);
    return app::kFailed;
  }

  int end(const SimStatus& status) const {
    if (next_swap_ < swaps_.size()) return failed("the run ended before all swaps were sent");
    if (status.state == RunState::Finished) return app::kOk;
    return failed(fmt::format("the run did not finish: {}{}", enum_name(status.state),
                              status.message.empty() ? "" : ": " + status.message));
  }

  /// Why there is nothing more to wait for; a wait of more than two seconds says what it is for.
  std::optional<std::string> silence(const std::optional<SimStatus>& status) {
    const time::Nanoseconds now = app::monotonic_now();
    if (client_.statuses() != statuses_) {
      statuses_ = client_.statuses();
      heard_at_ = now;
    }
    if (!status && !told_ && now - begun_at_ > seconds(2)) {
      told_ = true;
      progress_.say("inslab follow: waits for a trajectory server in domain " +
                    std::to_string(options_.network.domain));
    }
    if (now - heard_at_ < time::from_seconds(options_.timeout_s)) return std::nullopt;
    return fmt::format("{} within {:g} s",
                       status ? "no word of the trajectory server" : "no trajectory server was found",
                       options_.timeout_s);
  }

  /// When the run is heard first.
  void say_whose_it_is(const SimStatus& status) {
    if (!said_run_) say("run " + app::run_id_text(status.run_id));
    said_run_ = true;
  }

  void say_when_it_begins(const SimStatus& status) {
    const bool begun =
        status.state == RunState::Running || status.state == RunState::Paused || status.state == RunState::Finished;
    if (!begun || begun_) return;
    begun_ = true;
    say("begins");
  }

  void send_swaps() {
    while (next_swap_ < swaps_.size() && client_.connected() && client_.send(swaps_[next_swap_])) ++next_swap_;
  }

  /// A run that was started paused goes on once each swap is in the journal, or refused: then none comes too late.
  void release(const SimStatus& status) {
    if (!options_.release || next_swap_ < swaps_.size() || !client_.connected()) return;
    const bool obeyed = status.state == RunState::Running || status.sim_time_ns > 0;
    if (obeyed) released_ = true;
    if (released_ || app::monotonic_now() < resume_again_at_) return;
    const auto refused = std::count_if(swaps_.begin(), swaps_.end(), [this](const AnyProfile& swap) {
      return !client_.acks(request_of(swap).request_id).empty();
    });
    if (status.journal_entries + static_cast<std::size_t>(refused) < swaps_.size()) return;
    client_.send({app::random_id(), CommandKind::Resume, 0.0});
    resume_again_at_ = app::monotonic_now() + seconds(1);
  }

  app::OwnEnding leaves_the_domain_{app::OwnEnding::Then::CodeStands};
  const FollowOptions& options_;
  const std::vector<AnyProfile>& swaps_;
  dds::Participant participant_;
  RunClient client_;
  Progress progress_;
  std::size_t next_swap_ = 0;
  bool said_run_ = false;
  bool begun_ = false;
  bool released_ = false;
  bool told_ = false;                     ///< what it waits for
  std::uint64_t statuses_ = 0;            ///< heard so far
  time::Nanoseconds begun_at_{0};         ///< CLOCK_MONOTONIC, as the next two
  time::Nanoseconds heard_at_{0};         ///< when a status came last
  time::Nanoseconds resume_again_at_{0};  ///< a command may be lost with its server's barrier still open
};

}  // namespace

void add_follow(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<FollowOptions>();
  CLI::App* command = app.add_subcommand(
      "follow",
      "Go along with a set that was started service by service: send the scenario's swaps, show how far it is, "
      "end with it");
  command->add_option("scenario", options->scenario, "scenario file (JSON)")->required();
  command->add_flag("--release", options->release,
                    "let the run, started with --paused, begin as soon as all the swaps are in its journal");
  command->add_option("--timeout", options->timeout_s, "seconds to wait after the last word of the set")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  options->network.add_to(*command);
  command->callback([options, &action] {
    action = [options] {
      const scenario::LoadedScenario loaded =
          scenario::load(options->scenario, options->network.unit, scenario::TrajectoryRows::LeaveOut);
      return Follower(*options, loaded).run();
    };
  });
}

}  // namespace inslab::cli
