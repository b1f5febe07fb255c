#include "tests/e2e/process.hpp"

#include <execinfo.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace inslab::e2e {

namespace {

/// A test that crashes, or that will not end, says where it is, since what happens among threads seldom comes again.
/// Addresses in the test itself are relative to its beginning, as addr2line takes them.
void say_where(int signal) {
  std::array<void*, 64> frames{};
  const int depth = backtrace(frames.data(), static_cast<int>(frames.size()));
  backtrace_symbols_fd(frames.data(), depth, STDERR_FILENO);
  if (signal == SIGALRM) return;
  std::signal(signal, SIG_DFL);
  raise(signal);
}

const bool says_where = [] {
  std::array<void*, 1> frame{};
  backtrace(frame.data(), 1);  // loads what it needs now
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGALRM}) std::signal(signal, &say_where);
  constexpr unsigned kBeforeItIsEnded_s = 5;
  if (const char* timeout_s = std::getenv("INSLAB_TEST_TIMEOUT_S")) {
    alarm(static_cast<unsigned>(std::atoi(timeout_s)) - kBeforeItIsEnded_s);
  }
  return true;
}();

std::string temporary_name(const char* pattern) {
  std::string name = (std::filesystem::temp_directory_path() / pattern).string();
  return name;
}

}  // namespace

Process::Process(const std::string& program, const std::vector<std::string>& arguments, const Limits& limits) {
  output_path_ = temporary_name("inslab-output-XXXXXX");
  const int output = mkstemp(output_path_.data());
  if (output < 0) throw std::runtime_error("no temporary file");
  const std::string ours = inslab::e2e::program(program);
  const std::string path = access(ours.c_str(), X_OK) == 0 ? ours : program;
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    if (limits.file_size_bytes) {
      const rlimit limit{*limits.file_size_bytes, *limits.file_size_bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    execvp(path.c_str(), argv.data());
    _exit(127);
  }
  close(output);
}

Process::~Process() {
  if (running()) {
    send(SIGKILL);
    wait(std::chrono::seconds(10));
  }
  std::filesystem::remove(output_path_);
}

void Process::send(int signal) const { kill(pid_, signal); }

bool Process::running() {
  if (exit_code_) return false;
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
  exit_code_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return false;
}

std::optional<int> Process::wait(std::chrono::nanoseconds timeout) {
  eventually([this] { return !running(); }, timeout);
  return exit_code_;
}

std::string Process::output() const {
  std::ostringstream text;
  text << std::ifstream(output_path_).rdbuf();
  return text.str();
}

bool Process::prints(const std::string& text, std::chrono::nanoseconds timeout) {
  return eventually([&] { return output().find(text) != std::string::npos; }, timeout);
}

TestFolder::TestFolder() : path_(temporary_name("inslab-test-XXXXXX")) {
  if (mkdtemp(path_.data()) == nullptr) throw std::runtime_error("no temporary folder");
}

TestFolder::~TestFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::vector<pid_t> children_named(pid_t parent, const std::string& program) {
  std::ifstream list("/proc/" + std::to_string(parent) + "/task/" + std::to_string(parent) + "/children");
  std::vector<pid_t> found;
  for (pid_t pid = 0; list >> pid;) {
    std::string command;
    std::getline(std::ifstream("/proc/" + std::to_string(pid) + "/cmdline"), command, '\0');
    if (command == program) found.push_back(pid);
  }
  return found;
}

std::string own_domain() { return std::to_string(20 + getpid() % 180); }

std::string program(const std::string& name) { return std::string(INSLAB_BINARY_DIR) + "/bin/" + name; }

std::string source(const std::string& path) { return std::string(INSLAB_SOURCE_DIR) + "/" + path; }

void pause_between_looks() {
  constexpr int kMilliseconds = 10;
  poll(nullptr, 0, kMilliseconds);
}

}  // namespace inslab::e2e
