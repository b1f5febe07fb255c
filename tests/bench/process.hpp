#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace inslab::bench {

/// What a process has used when it ended.
struct ProcessEnd {
  bool good = false;  ///< ended by itself, with exit code 0
  double cpu_s = 0.0;
  double peak_rss_mb = 0.0;
};

/// A process that was started by the bench; ended when this goes.
class Process {
 public:
  /// Starts the program that stands beside this one; its standard output goes nowhere. Throws std::runtime_error when
  /// it cannot.
  Process(const std::string& program, std::vector<std::string> arguments);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits for its end; a process that is still there after `timeout` is killed and not good.
  ProcessEnd wait(std::chrono::nanoseconds timeout);

  const std::string& program() const { return program_; }

 private:
  bool reap(int options);

  std::string program_;
  pid_t pid_ = -1;
  ProcessEnd end_;
};

}  // namespace inslab::bench
