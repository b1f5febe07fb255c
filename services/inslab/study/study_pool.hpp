#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace inslab::study {

/// Runs of a study, each a process of its own, so many at a time: one that dies takes none along.
class StudyPool {
 public:
  /// One run under way; destroying it ends it.
  class Process {
   public:
    Process() = default;
    virtual ~Process() = default;
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;
    virtual bool has_ended() = 0;
    /// Why it failed, when it has ended; nothing when all is well.
    virtual std::optional<std::string> failure() = 0;
  };
  struct Work {
    std::function<std::unique_ptr<Process>(std::uint32_t run)> start;
    std::function<void(std::uint32_t run, const std::string& why)> failed;
    std::function<void(std::size_t done, std::size_t all)> progress;  ///< every tenth of the way
    std::function<void()> rest;                                       ///< some milliseconds
    std::function<bool()> interrupted;
  };

  StudyPool(std::size_t jobs, Work work) : jobs_(jobs), work_(std::move(work)) {}

  /// Returns when each has ended; when interrupted, those under way are ended.
  void run(std::deque<std::uint32_t> todo);

 private:
  struct Active {
    std::uint32_t run;
    std::unique_ptr<Process> process;
  };
  void collect();
  void show(std::size_t done, std::size_t all);

  std::size_t jobs_;
  Work work_;
  std::vector<Active> active_;
  std::size_t shown_ = 0;
};

/// A study as it was asked for on the command line.
struct StudyOptions {
  std::string scenario;
  std::string parameters;
  std::string directory;
  std::string part;
  std::uint32_t runs = 100;
  std::uint32_t jobs = std::max(1u, std::thread::hardware_concurrency());
  std::optional<std::uint32_t> one;
  bool draw_start = false;
  bool summary_only = false;

  /// The command line of one of its runs.
  std::vector<std::string> arguments_of(std::uint32_t run) const;
};

/// A process of `inslab-study` with these arguments.
std::unique_ptr<StudyPool::Process> study_process(const std::vector<std::string>& arguments);

}  // namespace inslab::study
