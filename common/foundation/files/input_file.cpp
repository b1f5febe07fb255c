#include "inslab/foundation/files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/files_read.hpp"

namespace inslab::files {

InputFile::InputFile(const std::string& path) : path_(path) {
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe must not block here
  if (descriptor_ < 0) {
    const std::string reason = std::generic_category().message(errno);
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(path_, error);
    const bool is_relative = !error && std::filesystem::path(path_).is_relative();
    throw ReadError(path_ + ": cannot open: " + reason +
                    (is_relative ? "; it was looked for as " + whole.lexically_normal().string() : ""));
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor_);
    throw ReadError(path_ + ": is not a regular file");
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  note_file_read(path_);
}

InputFile::~InputFile() { ::close(descriptor_); }

void InputFile::read(std::uint64_t offset, std::uint8_t* out, std::size_t size) const {
  constexpr std::size_t kPiece = std::size_t{1} << 30;
  while (size > 0) {
    const ssize_t count = ::pread(descriptor_, out, std::min(kPiece, size), static_cast<off_t>(offset));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw ReadError(path_ + ": cannot read: " + std::generic_category().message(errno));
    if (count == 0) throw ReadError(path_, offset, std::to_string(size) + " more bytes, the file ends");
    offset += static_cast<std::uint64_t>(count);
    out += count;
    size -= static_cast<std::size_t>(count);
  }
}

}  // namespace inslab::files
