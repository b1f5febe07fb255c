#include "inslab/foundation/host/command_ending.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "inslab/foundation/host/shutdown.hpp"
#include "inslab/foundation/host/shutdown_signal.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::host {

namespace {

/// After an own ending: the rest of the command's work, so that all of it is over 2 s after the signal.
constexpr std::chrono::milliseconds kForTheRest{1500};

struct State {
  std::mutex mutex;
  std::condition_variable changed;
  int own_endings = 0;
  bool answered = false;  ///< by an own ending that lived when the signal came, or after
  bool code_stands = false;
  bool is_finished = false;
  std::string note;
};

State& state() {
  static State* const all = new State;  // the watcher outlives what is destroyed at exit
  return *all;
}

std::string ended_words(const std::string& command, const std::string& note) {
  const int signal = shutdown_signal();
  const char* name = ::sigabbrev_np(signal);
  return text::shown("inslab " + command + ": ended by SIG" + (name == nullptr ? "" : name) + ", exit code " +
                     std::to_string(128 + signal) + (note.empty() ? "; what was not whole is removed" : "; " + note)) +
         "\n";
}

void write_all(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = ::write(descriptor, text.data() + done, text.size() - done);
    if (count <= 0 && errno != EINTR) return;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
}

}  // namespace

struct CommandEnding::Watcher {
  int read_end = -1;
  int write_end = -1;
  std::thread thread;
};

CommandEnding::CommandEnding(std::string command, std::function<void()> discard)
    : command_(std::move(command)), discard_(std::move(discard)), watcher_(std::make_unique<Watcher>()) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  ::fcntl(ends[1], F_SETFL, O_NONBLOCK);
  watcher_->read_end = ends[0];
  watcher_->write_end = ends[1];
  watcher_->thread = std::thread([this] { watch(); });
  wake_on_shutdown(watcher_->write_end);
  if (shutdown_requested()) write_all(watcher_->write_end, "s");  // it came before
}

CommandEnding::~CommandEnding() {
  wake_on_shutdown(-1);
  write_all(watcher_->write_end, "q");
  watcher_->thread.join();
  ::close(watcher_->read_end);
  ::close(watcher_->write_end);
}

int CommandEnding::finished(int code) {
  State& all = state();
  std::unique_lock<std::mutex> lock(all.mutex);
  if (shutdown_signal() == 0 || (all.answered && all.code_stands)) {
    all.is_finished = true;
    all.changed.notify_all();
    return code;
  }
  // The watcher ends the process; it holds the lock while it does.
  if (!all.answered) all.changed.wait(lock, [] { return false; });
  all.is_finished = true;
  all.changed.notify_all();
  std::fflush(stdout);
  write_all(STDERR_FILENO, ended_words(command_, all.note));
  return 128 + shutdown_signal();
}

void CommandEnding::watch() {
  State& all = state();
  while (true) {
    char byte = 0;
    const ssize_t count = ::read(watcher_->read_end, &byte, 1);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0 || byte == 'q') return;
    std::unique_lock<std::mutex> lock(all.mutex);
    const auto is_finished = [&] { return all.is_finished; };
    if (all.own_endings > 0) {
      all.answered = true;
      all.changed.wait(lock, [&] { return all.own_endings == 0 || all.is_finished; });
      all.changed.wait_for(lock, kForTheRest, is_finished);
    }
    if (is_finished()) return;
    end_now();
  }
}

void CommandEnding::end_now() {
  discard_();
  // What was printed goes out, unless the thread that prints is in the midst of it.
  if (::ftrylockfile(stdout) == 0) ::fflush_unlocked(stdout);
  write_all(STDERR_FILENO, ended_words(command_, state().note));
  ::_exit(128 + shutdown_signal());
}

OwnEnding::OwnEnding(Then then) {
  State& all = state();
  const std::lock_guard<std::mutex> lock(all.mutex);
  ++all.own_endings;
  all.code_stands = then == Then::CodeStands;
}

OwnEnding::~OwnEnding() {
  State& all = state();
  const std::lock_guard<std::mutex> lock(all.mutex);
  --all.own_endings;
  all.changed.notify_all();
}

void note_for_ending(const std::string& words) {
  State& all = state();
  const std::lock_guard<std::mutex> lock(all.mutex);
  all.note = words;
}

}  // namespace inslab::host
