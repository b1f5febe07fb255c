#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace inslab::e2e {

/// A program of build/bin, else of the path, started for a test: its output goes to a file, every wait has a deadline,
/// and it is gone when the test is.
class Process {
 public:
  struct Limits {
    std::optional<std::uint64_t> file_size_bytes;  ///< writing a larger file fails, as on a full disk
  };

  Process(const std::string& program, const std::vector<std::string>& arguments, const Limits& limits = {});
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal) const;
  bool running();
  /// The exit code (128 + signal when one ended it), or nothing when it still runs after `timeout`.
  std::optional<int> wait(std::chrono::nanoseconds timeout);
  /// What it has printed so far, to both outputs.
  std::string output() const;
  /// Waits until the output contains `text`.
  bool prints(const std::string& text, std::chrono::nanoseconds timeout);

 private:
  pid_t pid_ = 0;
  std::string output_path_;
  std::optional<int> exit_code_;
};

/// A folder for one test's files, removed afterwards.
class TestFolder {
 public:
  TestFolder();
  ~TestFolder();
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

/// A DDS domain of this test process's own, so that tests do not hear each other.
std::string own_domain();

/// The processes that `parent` has started and that run a program of this name.
std::vector<pid_t> children_named(pid_t parent, const std::string& program);

/// Path of a program of the build.
std::string program(const std::string& name);

/// Path of a file in the product's sources.
std::string source(const std::string& path);

/// Waits until `condition` holds; false at the deadline.
template <class Condition>
bool eventually(const Condition& condition, std::chrono::nanoseconds timeout);

void pause_between_looks();

template <class Condition>
bool eventually(const Condition& condition, std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    pause_between_looks();
  }
  return true;
}

}  // namespace inslab::e2e
