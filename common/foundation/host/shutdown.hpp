#pragma once

namespace inslab::host {

/// SIGINT, SIGTERM and a SIGHUP that is not ignored set a flag; SIGPIPE and SIGXFSZ become errors of their call.
void install_signal_handlers();

/// True once a signal to end has come.
bool shutdown_requested();

}  // namespace inslab::host
