#include "app/shutdown.hpp"

#include <csignal>

namespace inslab::app {

namespace {

volatile std::sig_atomic_t g_requested = 0;

void request_shutdown(int) { g_requested = 1; }

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

}  // namespace inslab::app
