#include "inslab/foundation/files/mapped_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace inslab::files {
namespace {

[[noreturn]] void fail(const std::string& path, const char* what) {
  throw std::runtime_error(path + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

MappedFile::MappedFile(const std::string& path, std::size_t size) : path_(path) {
  constexpr mode_t kUserOnly = S_IRUSR | S_IWUSR;
  descriptor_ = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kUserOnly);
  if (descriptor_ < 0) fail(path, "cannot be opened");
  try {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) fail(path, "another process has it");
    struct stat file {};
    if (fstat(descriptor_, &file) != 0) fail(path, "cannot be examined");
    map(std::max(size, static_cast<std::size_t>(file.st_size)));
  } catch (...) {
    close(descriptor_);
    throw;
  }
}

MappedFile::~MappedFile() {
  munmap(data_, size_);
  close(descriptor_);
}

void MappedFile::grow(std::size_t size) {
  if (size <= size_) return;
  reserve(size);
  void* moved = mremap(data_, size_, size, MREMAP_MAYMOVE);
  if (moved == MAP_FAILED) fail(path_, "cannot be mapped");
  data_ = static_cast<std::uint8_t*>(moved);
  size_ = size;
}

/// Room on the disk is taken now: writing into a hole of a full one would end the process with SIGBUS.
void MappedFile::reserve(std::size_t size) {
  if (const int error = posix_fallocate(descriptor_, 0, static_cast<off_t>(size)); error != 0) {
    errno = error;
    fail(path_, "has no room");
  }
}

void MappedFile::map(std::size_t size) {
  reserve(size);
  void* mapped = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
  if (mapped == MAP_FAILED) fail(path_, "cannot be mapped");
  data_ = static_cast<std::uint8_t*>(mapped);
  size_ = size;
}

}  // namespace inslab::files
