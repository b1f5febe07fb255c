#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace inslab::live {

/// The processes that `inslab run` has started. Each has its own process group, so that Ctrl-C at the terminal reaches
/// only the one who started them, who ends them in order. When that one ends without having done so, however it ends,
/// each gets a SIGTERM from the kernel.
class ChildProcesses {
 public:
  ChildProcesses() = default;
  ~ChildProcesses();  ///< ends those that still run: SIGTERM, then SIGKILL after 5 s
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  /// Starts a program that stands beside this one. Throws std::runtime_error when it cannot.
  void start(const std::string& program, const std::vector<std::string>& arguments);

  /// Notes who has ended. Does not wait.
  void poll();
  bool all_ended() const;
  /// The first that ended with another exit code than 0, in words; nothing when all is well.
  std::optional<std::string> failure() const;
  /// In words, those whose end was not told before, whatever their exit code.
  std::vector<std::string> newly_ended();
  /// Whether the program has ended already.
  bool has_ended(const std::string& program) const;
  /// One that ended.
  struct Ended {
    std::string program;
    std::uint32_t sensor = 0;
    std::vector<std::string>& arguments;  ///< may be changed for the next start
    std::string words;                    ///< "inslab-imu-injector 0 was ended by signal 9 (Killed)"
    bool too_often;                       ///< a few times in a row it did not live for long
  };
  /// Goes through those that a signal ended, each once, and starts again those for which `again` says so. Returns what
  /// was started again, in words, one line for each.
  std::vector<std::string> restart_killed(const std::function<bool(Ended&)>& again);
  /// Counts the end of this one as good: it had done its work.
  void forgive(const std::string& program, std::uint32_t sensor);
  /// The pids of those that run.
  std::vector<std::pair<std::string, pid_t>> running() const;
  /// Sends SIGTERM to all that run.
  void terminate();
  void wait_for_end(std::chrono::nanoseconds timeout);

 private:
  struct Child {
    std::string program;
    std::vector<std::string> arguments;
    pid_t pid = 0;
    std::chrono::steady_clock::time_point started_at;
    int short_lives = 0;  ///< in a row
    bool ended = false;
    bool judged = false;  ///< whether to start it again
    bool told = false;    ///< its end
    int exit_code = 0;    ///< 128 + signal when a signal ended it
  };
  static std::optional<std::uint32_t> sensor_of(const Child& child);
  static std::string words_of_end(const Child& child);
  static pid_t spawn(const std::string& program, const std::vector<std::string>& arguments);
  void signal_all(int signal) const;

  std::vector<Child> children_;
};

}  // namespace inslab::live
