#pragma once

#include <functional>
#include <memory>
#include <string>

namespace inslab::host {

/// How every command ends when SIGINT or SIGTERM comes: at once, wherever it is in its work. A thread waits for the
/// signal, has `discard` take away what is not whole, says so in a last line and ends the process with 128 + the
/// signal's number, as a shell expects it. So no computation needs to look for signals, and none is deaf to them.
///
/// A part of a command that must do something itself before it goes (end the processes that it started, leave a DDS
/// domain) says so by an OwnEnding.
class CommandEnding {
 public:
  /// One in a process, with the handlers of install_signal_handlers() in place. `discard` is called on another thread.
  CommandEnding(std::string command, std::function<void()> discard);
  ~CommandEnding();
  CommandEnding(const CommandEnding&) = delete;
  CommandEnding& operator=(const CommandEnding&) = delete;

  /// The command has done its work and would return `code`: what it returns. Does not come back when a signal that
  /// nobody answered is just ending the process.
  int finished(int code);

 private:
  void watch();
  [[noreturn]] void end_now();

  std::string command_;
  std::function<void()> discard_;
  struct Watcher;
  std::unique_ptr<Watcher> watcher_;
};

/// While one lives, what created it answers signals itself: it looks at shutdown_requested(). Once it is gone after a
/// signal, the command has 1.5 s for the rest of its work.
class OwnEnding {
 public:
  enum class Then {
    CodeStands,    ///< the command's own exit code and last line say what came of it
    EndsBySignal,  ///< as every other command: 128 + the signal's number
  };
  explicit OwnEnding(Then then);
  ~OwnEnding();
  OwnEnding(const OwnEnding&) = delete;
  OwnEnding& operator=(const OwnEnding&) = delete;
};

/// What the last line adds when a signal ends the command from now on, such as "the log X is whole"; empty: nothing.
void note_for_ending(const std::string& words);

}  // namespace inslab::host
