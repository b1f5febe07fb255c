#include "inslab/services/inslab/live/child_processes.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace inslab::live {

namespace {

constexpr std::chrono::seconds kShortLife(3);
/// In a row, of a process that ends itself; and of one that somebody else kills (SIGKILL), as a soak does.
constexpr int kShortLives = 5;
constexpr int kShortLivesOfAKilled = 25;

}  // namespace

ChildProcesses::~ChildProcesses() {
  poll();
  if (all_ended()) return;
  terminate();
  wait_for_end(std::chrono::seconds(5));
  if (!all_ended()) signal_all(SIGKILL);
  wait_for_end(std::chrono::seconds(5));
}

void ChildProcesses::start(const std::string& program, const std::vector<std::string>& arguments) {
  Child child;
  child.program = program;
  child.arguments = arguments;
  child.pid = spawn(program, arguments);
  child.started_at = std::chrono::steady_clock::now();
  children_.push_back(std::move(child));
}

std::vector<std::string> ChildProcesses::restart_killed(const std::function<bool(Ended&)>& again) {
  std::vector<std::string> lines;
  for (Child& child : children_) {
    if (!child.ended || child.judged || child.exit_code <= 128) continue;
    child.judged = true;
    const auto now = std::chrono::steady_clock::now();
    child.short_lives = now - child.started_at < kShortLife ? child.short_lives + 1 : 0;
    Ended ended{child.program, sensor_of(child).value_or(0), child.arguments, words_of_end(child),
                child.short_lives >= (child.exit_code == 128 + SIGKILL ? kShortLivesOfAKilled : kShortLives)};
    if (!again(ended)) continue;
    lines.push_back(ended.words + " and started again");
    child.pid = spawn(child.program, child.arguments);
    child.started_at = now;
    child.ended = child.judged = child.told = false;
    child.exit_code = 0;
  }
  return lines;
}

void ChildProcesses::forgive(const std::string& program, std::uint32_t sensor) {
  for (Child& child : children_) {
    if (child.ended && child.program == program && sensor_of(child).value_or(0) == sensor) child.exit_code = 0;
  }
}

std::optional<std::uint32_t> ChildProcesses::sensor_of(const Child& child) {
  const auto option = std::find(child.arguments.begin(), child.arguments.end(), "--sensor");
  if (option == child.arguments.end() || std::next(option) == child.arguments.end()) return std::nullopt;
  const std::string& number = *std::next(option);
  std::uint32_t sensor = 0;
  std::from_chars(number.data(), number.data() + number.size(), sensor);
  return sensor;
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
  if (access(path.c_str(), X_OK) != 0) {
    throw std::runtime_error(
        path.string() + ": " + std::strerror(errno) +
        "; the run needs it. All that runs may need: cmake --build --preset release --target live_set sensors");
  }
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error("cannot start " + program + ": " + std::strerror(errno));
  if (pid == 0) {
    setpgid(0, 0);
    // Of the thread that forked: callers do so from the main one. It may be gone already.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
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
  if (const auto sensor = sensor_of(child)) words += " " + std::to_string(*sensor);
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

}  // namespace inslab::live
