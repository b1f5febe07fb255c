#include "inslab/foundation/files/unfinished.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <set>
#include <utility>

namespace inslab::files {

namespace {

struct Unfinished {
  std::recursive_mutex mutex;
  std::multiset<std::string> files;
  std::set<pid_t> programs;
};

Unfinished& unfinished() {
  static Unfinished* const all = new Unfinished;  // used until the process is gone
  return *all;
}

}  // namespace

void note_unfinished(const std::string& path) {
  const auto lock = hold_unfinished();
  unfinished().files.insert(path);
}

void forget_unfinished(const std::string& path) {
  const auto lock = hold_unfinished();
  const auto found = unfinished().files.find(path);
  if (found != unfinished().files.end()) unfinished().files.erase(found);
}

UnfinishedFile::UnfinishedFile(std::string path) : path_(std::move(path)) { note_unfinished(path_); }

UnfinishedFile::~UnfinishedFile() { forget_unfinished(path_); }

int wait_for_program(pid_t program) {
  {
    const auto lock = hold_unfinished();
    unfinished().programs.insert(program);
  }
  // Its number stays its own until it is waited for, which comes after it is forgotten here.
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(program), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) continue;
  const auto lock = hold_unfinished();
  unfinished().programs.erase(program);
  int status = 0;
  while (::waitpid(program, &status, 0) < 0) {
    if (errno != EINTR) return -1;
  }
  return status;
}

std::unique_lock<std::recursive_mutex> hold_unfinished() {
  return std::unique_lock<std::recursive_mutex>(unfinished().mutex);
}

void discard_unfinished() {
  unfinished().mutex.lock();
  for (const pid_t program : unfinished().programs) ::kill(program, SIGKILL);
  for (const std::string& file : unfinished().files) ::unlink(file.c_str());
  for (const std::string& folder : unfinished().files) ::rmdir(folder.c_str());  // of what is left, the empty folders
}

}  // namespace inslab::files
