#include "inslab/foundation/host/shutdown.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>

#include "inslab/foundation/host/shutdown_signal.hpp"

namespace inslab::host {

namespace {

volatile std::sig_atomic_t g_requested = 0;
std::atomic<int> g_wake{-1};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may take no lock");

void request_shutdown(int signal) {
  if (g_requested == 0) g_requested = signal;
  const int descriptor = g_wake;
  if (descriptor < 0) return;
  const int kept = errno;
  const char byte = 's';
  if (::write(descriptor, &byte, 1) != 1) errno = kept;  // full: the watcher has been woken already
  errno = kept;
}

}  // namespace

void install_signal_handlers() {
  struct sigaction action = {};
  action.sa_handler = request_shutdown;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A terminal that is closed ends what was started in it, unless that was started to outlive it (nohup).
  struct sigaction hangup = {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool shutdown_requested() { return g_requested != 0; }

int shutdown_signal() { return g_requested; }

void wake_on_shutdown(int descriptor) { g_wake = descriptor; }

}  // namespace inslab::host
