#include "inslab/foundation/files/files_read.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <tuple>

namespace inslab::files {

namespace {

/// Device, inode, and when the inode was made, since the number of one that is gone is given to another file. File
/// systems that do not know the time give 0.
using Identity = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::int64_t, std::uint32_t>;

std::optional<Identity> identity_of(const std::string& path) {
  struct statx status {};
  if (::statx(AT_FDCWD, path.c_str(), 0, STATX_INO | STATX_BTIME, &status) != 0) return std::nullopt;
  return Identity{status.stx_dev_major, status.stx_dev_minor, status.stx_ino, status.stx_btime.tv_sec,
                  status.stx_btime.tv_nsec};
}

struct Noted {
  std::mutex mutex;
  std::set<Identity> files;
  std::vector<std::string> paths;
};

Noted& noted() {
  static Noted all;
  return all;
}

}  // namespace

void note_file_read(const std::string& path) {
  const auto identity = identity_of(path);
  if (!identity) return;
  const std::lock_guard<std::mutex> lock(noted().mutex);
  noted().files.insert(*identity);
  auto& paths = noted().paths;
  if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
}

bool is_file_read(const std::string& path) {
  const auto identity = identity_of(path);
  if (!identity) return false;
  const std::lock_guard<std::mutex> lock(noted().mutex);
  return noted().files.count(*identity) > 0;
}

std::vector<std::string> files_read() {
  const std::lock_guard<std::mutex> lock(noted().mutex);
  return noted().paths;
}

}  // namespace inslab::files
