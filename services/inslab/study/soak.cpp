#include "inslab/services/inslab/study/soak.hpp"

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <thread>

#include "inslab/bus/client/shm_segments.hpp"
#include "inslab/formats/log/log_info.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/service_names.hpp"
#include "inslab/services/inslab/study/soak_events.hpp"
#include "inslab/services/inslab/study/usage_watch.hpp"

namespace inslab::study {

namespace {

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

}  // namespace

class Soak::Work {
 public:
  Work(const SoakOptions& options, const scenario::LoadedScenario& scenario, Say say)
      : options_(options),
        say_(std::move(say)),
        end_s_(options.hours * 3600.0),
        events_(scenario, options.profiles, options.seed, options.often),
        run_(options.run, scenario) {}

  /// True when everything held.
  bool go() {
    const auto segments_before = client::find_shm_segments("/dev/shm").size();
    const auto began = host::monotonic_now();
    const Load load(options_.load);
    run_.start_services();
    run_.follow([this] { tick(); });
    const double took_s = time::to_seconds(host::monotonic_now() - began);
    require(!run_.failure(), run_.failure().value_or(""));
    say("\n{:.2f} h of sim time in {:.1f} min: {:.0f} x real time; seed {}: {} swaps, {} kills, {} pauses\n",
        sim_time_s_ / 3600.0, took_s / 60.0, sim_time_s_ / took_s, options_.seed, swaps_.size(), kills_, pauses_);
    require(sim_time_s_ >= end_s_ * 0.999, fmt::format("the run ended at {:.0f} s", sim_time_s_));
    judge_answers();
    judge_usage();
    // Killed services leave their segments behind: inslab doctor --clean takes them away.
    std::size_t stale = 0;
    for (const client::ShmSegment& segment : client::find_shm_segments("/dev/shm")) stale += segment.in_use ? 0 : 1;
    say("shared-memory segments: {} before, {} stale ones after\n", segments_before, stale);
    judge_log();
    for (const std::string& line : broken_) say("FAILED: {}\n", line);
    say("{}\n", broken_.empty() ? "everything held" : "the soak failed");
    return broken_.empty();
  }

 private:
  template <class... Arguments>
  void say(fmt::format_string<Arguments...> pattern, Arguments&&... arguments) const {
    say_(fmt::format(pattern, std::forward<Arguments>(arguments)...));
  }
  void require(bool holds, const std::string& otherwise) {
    if (!holds) broken_.push_back(otherwise);
  }

  void tick() {
    const auto status = run_.client().status();
    if (!status || has_ended(status->state) || status->state == RunState::Waiting) return;
    sim_time_s_ = time::to_seconds(status->sim_time_ns);
    if (!began_) kill(1);
    began_ = true;
    if (resume_at_ && host::monotonic_now() > *resume_at_) {
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
        resume_at_ = host::monotonic_now() + std::chrono::milliseconds(300);
        ++pauses_;
        break;
    }
  }

  void swap() {
    const catalog::AnyProfile swap = events_.next_swap();
    if (run_.client().send(swap)) swaps_.push_back(catalog::request_of(swap).request_id);
  }

  /// So many services at once, any but the one that is the clock.
  void kill(int count) {
    std::vector<pid_t> victims;
    for (const auto& [program, pid] : run_.services().running()) {
      if (program != catalog::kTrajectoryServer) victims.push_back(pid);
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
    if (host::monotonic_now() < next_look_ || !UsageWatch::wants(part)) return;
    next_look_ = host::monotonic_now() + std::chrono::seconds(1);
    for (const auto& [program, pid] : run_.services().running()) {
      const auto usage = usage_of(pid);
      if (usage) usage_.add(program, part, *usage);
    }
  }

  void judge_answers() {
    std::size_t unanswered = 0;
    for (const std::uint64_t id : swaps_) unanswered += run_.client().acks(id).empty() ? 1 : 0;
    // The last ones may lie after the last sample.
    require(unanswered <= 2, fmt::format("{} of {} swaps were not acknowledged", unanswered, swaps_.size()));
  }

  void judge_usage() {
    say_(usage_.text());
    for (const std::string& growth : usage_.growth()) require(false, growth);
  }

  void judge_log() {
    const log::LogInfo info = log::inspect_log(options_.run.log_file);
    require(info.closed_properly, "the log was not closed: " + info.ending);
    std::size_t recoveries = 0;
    for (const auto& record : info.metadata) recoveries += record.name.rfind("recovery/", 0) == 0 ? 1 : 0;
    say("\n{:<24}{:>14}{:>10}{:>10}\n", "stream", "samples", "missing", "twice");
    for (const log::TopicInfo& topic : info.topics) {
      if (!topic.is_numbered || topic.count == 0) continue;
      say("{:<24}{:>14}{:>10}{:>10}\n", topic.topic, topic.count, topic.missing, topic.duplicates);
      require(topic.missing == 0, topic.topic + ": samples are missing from the log");
    }
    say("log: {:.2f} GB, {} interruptions noted\n\n", static_cast<double>(info.file_size) * 1e-9, recoveries);
    require(kills_ == 0 || recoveries > 0, "the log does not say that services were started again");
  }

  const SoakOptions& options_;
  Say say_;
  double end_s_;
  SoakEvents events_;
  live::LiveRun run_;
  double sim_time_s_ = 0.0;
  std::vector<std::uint64_t> swaps_;
  int kills_ = 0;
  int pauses_ = 0;
  bool began_ = false;
  bool stopped_ = false;
  std::uint64_t next_command_ = 1;
  std::optional<time::Nanoseconds> resume_at_;
  time::Nanoseconds next_look_{0};
  UsageWatch usage_;
  std::vector<std::string> broken_;
};

Soak::Soak(const SoakOptions& options, const scenario::LoadedScenario& scenario, Say say)
    : work_(std::make_unique<Work>(options, scenario, std::move(say))) {}
Soak::~Soak() = default;

bool Soak::go() { return work_->go(); }

}  // namespace inslab::study
