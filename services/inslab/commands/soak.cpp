#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <thread>

#include "inslab/formats/log/log_info.hpp"
#include "inslab/foundation/files/output_place.hpp"
#include "inslab/foundation/host/exit_code.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/inslab/commands/commands.hpp"
#include "inslab/services/inslab/live/live_run.hpp"
#include "inslab/services/inslab/live/process_usage.hpp"
#include "inslab/services/inslab/live/shm_segments.hpp"
#include "inslab/services/inslab/live/soak_events.hpp"

namespace inslab::cli {

namespace {

struct SoakOptions {
  RunOptions run;
  double hours = 24.0;
  std::uint64_t seed = 1;
  double often = 1.0;
  int load = 0;
  std::string profiles = "config/profiles";
  bool keep_log = false;
};

/// The most of each service, over a part of the run.
struct Peak {
  std::uint64_t private_bytes = 0;
  std::uint64_t descriptors = 0;

  void add(const ProcessUsage& usage) {
    private_bytes = std::max(private_bytes, usage.private_bytes);
    descriptors = std::max(descriptors, usage.descriptors);
  }
};

/// What the services held in the first and in the last third of the run.
struct Growth {
  Peak first;
  Peak last;
};

/// Threads that do nothing and take all the time they are given, beside the set.
class Load {
 public:
  explicit Load(int threads) {
    for (int i = 0; i < threads; ++i) {
      threads_.emplace_back([this] {
        while (!ends_.load(std::memory_order_relaxed)) continue;
      });
    }
  }
  ~Load() {
    ends_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::atomic<bool> ends_{false};
  std::vector<std::thread> threads_;
};

class Soak {
 public:
  Soak(const SoakOptions& options, const scenario::LoadedScenario& scenario)
      : options_(options),
        end_s_(options.hours * 3600.0),
        events_(scenario, options.profiles, options.seed, options.often),
        run_(options.run, scenario) {}

  /// True when everything held.
  bool go() {
    const auto segments_before = find_shm_segments("/dev/shm").size();
    const auto began = app::monotonic_now();
    const Load load(options_.load);
    run_.start_services();
    run_.follow([this] { tick(); });
    const double took_s = time::to_seconds(app::monotonic_now() - began);
    require(!run_.failure(), run_.failure().value_or(""));
    fmt::print("\n{:.2f} h of sim time in {:.1f} min: {:.0f} x real time; seed {}: {} swaps, {} kills, {} pauses\n",
               sim_time_s_ / 3600.0, took_s / 60.0, sim_time_s_ / took_s, options_.seed, swaps_.size(), kills_,
               pauses_);
    require(sim_time_s_ >= end_s_ * 0.999, fmt::format("the run ended at {:.0f} s", sim_time_s_));
    judge_answers();
    judge_usage();
    // Killed services leave their segments behind: inslab doctor --clean takes them away.
    std::size_t stale = 0;
    for (const ShmSegment& segment : find_shm_segments("/dev/shm")) stale += segment.in_use ? 0 : 1;
    fmt::print("shared-memory segments: {} before, {} stale ones after\n", segments_before, stale);
    judge_log();
    for (const std::string& line : broken_) fmt::print("FAILED: {}\n", line);
    fmt::print("{}\n", broken_.empty() ? "everything held" : "the soak failed");
    return broken_.empty();
  }

 private:
  void require(bool holds, const std::string& otherwise) {
    if (!holds) broken_.push_back(otherwise);
  }

  void tick() {
    const auto status = run_.client().status();
    if (!status || has_ended(status->state) || status->state == RunState::Waiting) return;
    sim_time_s_ = static_cast<double>(status->sim_time_ns) * 1e-9;
    if (!began_) kill(1);
    began_ = true;
    if (resume_at_ && app::monotonic_now() > *resume_at_) {
      run_.client().send({next_command_++, CommandKind::Resume, 0.0});
      resume_at_.reset();
    }
    if (sim_time_s_ >= end_s_) {
      if (!stopped_) kill(1);
      if (!stopped_) run_.client().send({next_command_++, CommandKind::Stop, 0.0});
      stopped_ = true;
      return;
    }
    for (const SoakEvents::Event& event : events_.due(sim_time_s_)) cause(event);
    watch_usage();
  }

  void cause(const SoakEvents::Event& event) {
    switch (event.kind) {
      case SoakEvents::Kind::Swap:
        swap();
        break;
      case SoakEvents::Kind::Kill:
        kill(1);
        break;
      case SoakEvents::Kind::KillTwo:
        kill(2);
        break;
      case SoakEvents::Kind::KillInSwap:
        swap();
        kill(1);
        break;
      case SoakEvents::Kind::Pause:
        if (resume_at_) return;
        run_.client().send({next_command_++, CommandKind::Pause, 0.0});
        resume_at_ = app::monotonic_now() + std::chrono::milliseconds(300);
        ++pauses_;
        break;
    }
  }

  void swap() {
    const AnyProfile swap = events_.next_swap();
    if (run_.client().send(swap)) swaps_.push_back(request_of(swap).request_id);
  }

  /// So many services at once, any but the one that is the clock.
  void kill(int count) {
    std::vector<pid_t> victims;
    for (const auto& [program, pid] : run_.services().running()) {
      if (program != app::kTrajectoryServer) victims.push_back(pid);
    }
    for (; count > 0 && !victims.empty(); --count) {
      const auto victim = victims.begin() + static_cast<std::ptrdiff_t>(events_.pick(victims.size()));
      ::kill(*victim, SIGKILL);
      victims.erase(victim);
      ++kills_;
    }
  }

  void watch_usage() {
    const double part = sim_time_s_ / end_s_;
    if (app::monotonic_now() < next_look_ || (part > 0.34 && part < 0.66)) return;
    next_look_ = app::monotonic_now() + std::chrono::seconds(1);
    for (const auto& [program, pid] : run_.services().running()) {
      const auto usage = usage_of(pid);
      if (usage) (part < 0.5 ? usage_[program].first : usage_[program].last).add(*usage);
    }
  }

  void judge_answers() {
    std::size_t unanswered = 0;
    for (const std::uint64_t id : swaps_) unanswered += run_.client().acks(id).empty() ? 1 : 0;
    // The last ones may lie after the last sample.
    require(unanswered <= 2, fmt::format("{} of {} swaps were not acknowledged", unanswered, swaps_.size()));
  }

  void judge_usage() {
    constexpr std::uint64_t kMayGrow = 16 << 20;  // the log's own index among it: 0.6 kB a chunk
    constexpr std::uint64_t kDescriptors = 8;     // sockets that come and go with discovery
    fmt::print("\n{:<28}{:>14}{:>14}{:>14}{:>14}\n", "most, first and last third", "MB first", "MB last", "fds first",
               "fds last");
    for (const auto& [program, growth] : usage_) {
      const auto mb = [](std::uint64_t bytes) { return static_cast<double>(bytes) * 1e-6; };
      fmt::print("{:<28}{:>14.1f}{:>14.1f}{:>14}{:>14}\n", program, mb(growth.first.private_bytes),
                 mb(growth.last.private_bytes), growth.first.descriptors, growth.last.descriptors);
      require(growth.last.private_bytes <= growth.first.private_bytes + kMayGrow, program + ": its memory grew");
      require(growth.last.descriptors <= growth.first.descriptors + kDescriptors,
              program + ": it holds more descriptors");
    }
  }

  void judge_log() {
    const io::LogInfo info = io::inspect_log(options_.run.log_file);
    require(info.closed_properly, "the log was not closed: " + info.ending);
    std::size_t recoveries = 0;
    for (const auto& record : info.metadata) recoveries += record.name.rfind("recovery/", 0) == 0 ? 1 : 0;
    fmt::print("\n{:<24}{:>14}{:>10}{:>10}\n", "stream", "samples", "missing", "twice");
    for (const io::TopicInfo& topic : info.topics) {
      if (!topic.is_numbered || topic.count == 0) continue;
      fmt::print("{:<24}{:>14}{:>10}{:>10}\n", topic.topic, topic.count, topic.missing, topic.duplicates);
      require(topic.missing == 0, topic.topic + ": samples are missing from the log");
    }
    fmt::print("log: {:.2f} GB, {} interruptions noted\n\n", static_cast<double>(info.file_size) * 1e-9, recoveries);
    require(kills_ == 0 || recoveries > 0, "the log does not say that services were started again");
  }

  const SoakOptions& options_;
  double end_s_;
  SoakEvents events_;
  LiveRun run_;
  double sim_time_s_ = 0.0;
  std::vector<std::uint64_t> swaps_;
  int kills_ = 0;
  int pauses_ = 0;
  bool began_ = false;
  bool stopped_ = false;
  std::uint64_t next_command_ = 1;
  std::optional<time::Nanoseconds> resume_at_;
  time::Nanoseconds next_look_{0};
  std::map<std::string, Growth> usage_;
  std::vector<std::string> broken_;
};

int soak(SoakOptions options) {
  const scenario::LoadedScenario loaded = scenario::load(options.run.scenario);
  if (options.hours * 3600.0 > loaded.scenario.duration_s) {
    fmt::print(stderr, "inslab soak: {} lasts {:g} h; {:g} h were asked for\n", options.run.scenario,
               loaded.scenario.duration_s / 3600.0, options.hours);
    return app::kBadInput;
  }
  const std::string name = loaded.scenario.name + "-" + app::utc_text(app::realtime_now());
  options.run.clock.mode = "lockstep";
  Soak run(options, loaded);  // before anything is written: it throws when the unit has a set
  if (options.run.log_file.empty()) options.run.log_file = io::fresh_file("runs/soak-" + name, ".mcap");
  io::check_output(options.run.log_file);
  const bool good = run.go();
  if (good && !options.keep_log) {
    std::filesystem::remove(options.run.log_file);
    fmt::print("the log is removed; --keep-log keeps it\n");
  } else {
    fmt::print("log {}\n", options.run.log_file);
  }
  return good ? app::kOk : app::kFailed;
}

}  // namespace

void add_soak(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SoakOptions>();
  CLI::App* command = app.add_subcommand(kSoak.name, kSoak.purpose);
  command->add_option("scenario", options->run.scenario, "scenario file (JSON)")
      ->default_val("config/scenarios/soak.json");
  command->add_option("--hours", options->hours, "of sim time")
      ->check(CLI::Range(0.001, 1000.0))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of what happens when")->capture_default_str();
  command->add_option("--often", options->often, "so many times as many kills and pauses")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command->add_option("--load", options->load, "busy threads beside the set")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--profiles", options->profiles, "folder of the profiles to swap to")->capture_default_str();
  command->add_option("--log", options->run.log_file, "file to write; default runs/soak-NAME-TIME.mcap");
  command->add_flag("--keep-log", options->keep_log, "keep the log even when everything held");
  options->run.network.add_to(*command);
  add_overwrite(*command);
  command->callback([options, &action] { action = [options] { return soak(*options); }; });
}

}  // namespace inslab::cli
