#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace inslab::fuzz {

/// A file in memory that holds the fuzzer's bytes, for readers that take a path.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size, const char* name) : file_(memfd_create(name, MFD_CLOEXEC)) {
    if (write(file_, data, size) != static_cast<ssize_t>(size)) _exit(2);
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace inslab::fuzz
