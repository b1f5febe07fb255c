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
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

bool shutdown_requested() { return g_requested != 0; }

}  // namespace inslab::app
