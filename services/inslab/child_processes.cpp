#include "services/inslab/child_processes.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace inslab::cli {

ChildProcesses::~ChildProcesses() {
  poll();
  if (all_ended()) return;
  terminate();
  wait_for_end(std::chrono::seconds(5));
  if (!all_ended()) signal_all(SIGKILL);
  wait_for_end(std::chrono::seconds(5));
}

void ChildProcesses::start(const std::string& program, const std::vector<std::string>& arguments) {
  children_.push_back({program, arguments, spawn(program, arguments), false, false, 0});
}

std::vector<std::string> ChildProcesses::restart_killed_except(const std::string& program) {
  std::vector<std::string> lines;
  for (Child& child : children_) {
    if (!child.ended || child.exit_code <= 128 || child.program == program) continue;
    lines.push_back(words_of_end(child) + " and started again");
    child.pid = spawn(child.program, child.arguments);
    child.ended = child.told = false;
    child.exit_code = 0;
  }
  return lines;
}

std::vector<std::pair<std::string, pid_t>> ChildProcesses::running() const {
  std::vector<std::pair<std::string, pid_t>> running;
  for (const Child& child : children_) {
    if (!child.ended) running.emplace_back(child.program, child.pid);
  }
  return running;
}

pid_t ChildProcesses::spawn(const std::string& program, const std::vector<std::string>& arguments) {
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  if (access(path.c_str(), X_OK) != 0) throw std::runtime_error(path.string() + ": " + std::strerror(errno));
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("cannot start " + program + ": " + std::strerror(errno));
  if (pid == 0) {
    setpgid(0, 0);
    // The sockets of this process's DDS participant are not for the child.
    close_range(STDERR_FILENO + 1, ~0U, 0);
    execv(path.c_str(), argv.data());
    _exit(127);
  }
  return pid;
}

void ChildProcesses::poll() {
  for (Child& child : children_) {
    int status = 0;
    if (child.ended || waitpid(child.pid, &status, WNOHANG) != child.pid) continue;
    child.ended = true;
    child.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }
}

bool ChildProcesses::all_ended() const {
  for (const Child& child : children_) {
    if (!child.ended) return false;
  }
  return true;
}

std::optional<std::string> ChildProcesses::failure() const {
  for (const Child& child : children_) {
    if (!child.ended || child.exit_code == 0) continue;
    return words_of_end(child);
  }
  return std::nullopt;
}

/// "inslab-imu-injector --sensor 0 was ended by signal 9 (Killed)"
std::string ChildProcesses::words_of_end(const Child& child) {
  std::string words = child.program;
  const auto sensor = std::find(child.arguments.begin(), child.arguments.end(), "--sensor");
  if (sensor != child.arguments.end() && std::next(sensor) != child.arguments.end()) words += " " + *std::next(sensor);
  if (child.exit_code <= 128) return words + " ended with exit code " + std::to_string(child.exit_code);
  const int signal = child.exit_code - 128;
  return words + " was ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

std::vector<std::string> ChildProcesses::newly_ended() {
  std::vector<std::string> words;
  for (Child& child : children_) {
    if (!child.ended || child.told) continue;
    child.told = true;
    words.push_back(words_of_end(child));
  }
  return words;
}

bool ChildProcesses::has_ended(const std::string& program) const {
  for (const Child& child : children_) {
    if (child.program == program && child.ended) return true;
  }
  return false;
}

void ChildProcesses::signal_all(int signal) const {
  for (const Child& child : children_) {
    if (!child.ended) kill(child.pid, signal);
  }
}

void ChildProcesses::terminate() { signal_all(SIGTERM); }

void ChildProcesses::wait_for_end(std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!all_ended() && std::chrono::steady_clock::now() < deadline) {
    poll();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

}  // namespace inslab::cli
