#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>

namespace inslab::study {

/// What a process holds of the machine.
struct ProcessUsage {
  std::uint64_t private_bytes = 0;  ///< resident and its own: RssAnon
  std::uint64_t descriptors = 0;
};

/// From /proc; nothing when the process is gone.
std::optional<ProcessUsage> usage_of(pid_t pid);

}  // namespace inslab::study
