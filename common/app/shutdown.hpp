#pragma once

namespace inslab::app {

/// Lets SIGINT and SIGTERM set a flag, and SIGPIPE and SIGXFSZ come back as errors of the call that caused them.
void install_signal_handlers();

/// True once a signal to end has come.
bool shutdown_requested();

}  // namespace inslab::app
