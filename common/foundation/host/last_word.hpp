#pragma once

namespace inslab::host {

/// A service has said its last word, its files are closed: this process ends within three seconds, with `exit_code` at
/// the latest. Fast DDS 2.9.1 can lock itself up for good when a writer is taken down while one of its readers was
/// killed and is not forgotten yet: its heartbeat walks a history that is half released. Returns `exit_code`.
int after_the_last_word(int exit_code);

}  // namespace inslab::host
