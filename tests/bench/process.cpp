#include "tests/bench/process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <thread>

namespace inslab::bench {

namespace {

double seconds_of(const timeval& value) {
  return static_cast<double>(value.tv_sec) + 1e-6 * static_cast<double>(value.tv_usec);
}

}  // namespace

Process::Process(const std::string& program, std::vector<std::string> arguments) : program_(program) {
  const auto path = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  if (access(path.c_str(), X_OK) != 0) throw std::runtime_error(path.string() + " is not there: build it first");
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("cannot start " + program);
  if (pid_ == 0) {
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    execv(path.c_str(), argv.data());
    _exit(127);
  }
}

Process::~Process() {
  if (pid_ < 0) return;
  kill(pid_, SIGTERM);
  wait(std::chrono::seconds(5));
}

bool Process::reap(int options) {
  int status = 0;
  rusage used{};
  if (pid_ < 0) return true;
  if (wait4(pid_, &status, options, &used) != pid_) return false;
  pid_ = -1;
  end_.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  end_.cpu_s = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  end_.peak_rss_mb = static_cast<double>(used.ru_maxrss) * 1024e-6;
  return true;
}

ProcessEnd Process::wait(std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  while (!reap(WNOHANG)) {
    if (std::chrono::steady_clock::now() > deadline) {
      kill(pid_, SIGKILL);
      reap(0);
      end_.good = false;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  return end_;
}

}  // namespace inslab::bench
