#include "inslab/bus/dds/file_access.hpp"

#include <fmt/format.h>
#include <linux/posix_acl_xattr.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace inslab::dds {

namespace {

struct stat look_at(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) throw std::runtime_error(file.string() + ": " + std::strerror(errno));
  return status;
}

// Of an access list, linux/posix_acl.h, which is not for programs.
enum Tag : unsigned { kUser = 0x02, kGroupOfFile = 0x04, kGroup = 0x08, kMask = 0x10, kOthers = 0x20 };
constexpr unsigned kRead = 4, kWrite = 2;

}  // namespace

AccessOfOthers access_of_others(const std::filesystem::path& file) {
  const struct stat status = look_at(file);
  constexpr std::size_t kMaxListBytes = 4096;
  alignas(posix_acl_xattr_header) std::array<char, kMaxListBytes> list{};
  const ssize_t bytes = getxattr(file.c_str(), "system.posix_acl_access", list.data(), list.size());
  constexpr auto kHeader = sizeof(posix_acl_xattr_header), kEntry = sizeof(posix_acl_xattr_entry);
  if (bytes < static_cast<ssize_t>(kHeader)) {
    return {(status.st_mode & (S_IRGRP | S_IROTH)) != 0, (status.st_mode & (S_IWGRP | S_IWOTH)) != 0};
  }
  unsigned granted = 0, others = 0, mask = kRead | kWrite;
  for (std::size_t at = kHeader; at + kEntry <= static_cast<std::size_t>(bytes); at += kEntry) {
    posix_acl_xattr_entry entry{};
    std::memcpy(&entry, list.data() + at, kEntry);
    const bool is_ours = entry.e_tag == kUser && (entry.e_id == geteuid() || entry.e_id == 0);
    if (entry.e_tag == kMask) mask = entry.e_perm;
    if (entry.e_tag == kOthers) others = entry.e_perm;
    if ((entry.e_tag == kUser && !is_ours) || entry.e_tag == kGroup || entry.e_tag == kGroupOfFile) {
      granted |= entry.e_perm;
    }
  }
  const unsigned effective = (granted & mask) | others;
  return {(effective & kRead) != 0, (effective & kWrite) != 0};
}

std::string mode_text(const std::filesystem::path& file) {
  return fmt::format("{:04o}", look_at(file).st_mode & 07777);
}

}  // namespace inslab::dds
