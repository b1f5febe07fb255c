#include "inslab/bus/client/shm_segments.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>

namespace inslab::client {

namespace {

/// Fast DDS holds an exclusive or shared flock on the lock file for as long as it uses the segment; the kernel drops it
/// when the process ends, however it ends.
bool is_locked(const std::filesystem::path& lock_file) {
  const int file = open(lock_file.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return true;
  const bool locked = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return locked;
}

/// Fast DDS 2.9 calls its files fastrtps_..., 3.x fastdds_...
bool is_of_fast_dds(const std::string& name) {
  return name.rfind("fastrtps_", 0) == 0 || name.rfind("fastdds_", 0) == 0;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<ShmSegment> find_shm_segments(const std::filesystem::path& directory) {
  std::vector<ShmSegment> segments;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!is_of_fast_dds(name) || ends_with(name, "_el") || ends_with(name, "_sl")) continue;
    // A data segment has a lock file of its owner (_el); a port has one of its reader (_el) or its readers (_sl).
    ShmSegment segment{entry.path(), {}, false};
    for (const char* suffix : {"_el", "_sl"}) {
      const std::filesystem::path lock_file = entry.path().string() + suffix;
      if (!std::filesystem::exists(lock_file)) continue;
      segment.lock_file = lock_file;
      segment.in_use = segment.in_use || is_locked(lock_file);
    }
    if (segment.lock_file.empty()) continue;  // made by something else, or just being made
    segments.push_back(segment);
  }
  std::sort(segments.begin(), segments.end(), [](const ShmSegment& a, const ShmSegment& b) { return a.file < b.file; });
  return segments;
}

std::size_t remove_stale(const std::vector<ShmSegment>& segments) {
  std::size_t removed = 0;
  for (const ShmSegment& segment : segments) {
    if (segment.in_use) continue;
    std::error_code failed;
    removed += std::filesystem::remove(segment.file, failed) ? 1 : 0;
    std::filesystem::remove(segment.lock_file, failed);
  }
  return removed;
}

}  // namespace inslab::client
