#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace inslab::client {

/// A shared-memory segment of Fast DDS: its file and the file whose lock says that its owner lives.
struct ShmSegment {
  std::filesystem::path file;
  std::filesystem::path lock_file;
  bool in_use = false;
};

/// The Fast DDS segments in `directory` (/dev/shm). A process that is killed leaves its own behind. Files that this
/// user may not open count as in use.
std::vector<ShmSegment> find_shm_segments(const std::filesystem::path& directory);

/// Removes the segments that nobody uses; returns how many.
std::size_t remove_stale(const std::vector<ShmSegment>& segments);

}  // namespace inslab::client
