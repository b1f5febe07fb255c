#pragma once

namespace inslab::host {

/// Which signal foundation/host/shutdown.hpp speaks of: the first to end that came; 0: none has.
int shutdown_signal();

/// From now on each signal to end also writes a byte to this descriptor, which must not block; -1: to none.
void wake_on_shutdown(int descriptor);

}  // namespace inslab::host
