#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace inslab::files {

/// A regular file opened for reading at any place.
class InputFile {
 public:
  /// Throws ReadError when it cannot be opened or is not a regular file.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Fills `out` with the `size` bytes from `offset`. Throws ReadError when the file ends before them.
  void read(std::uint64_t offset, std::uint8_t* out, std::size_t size) const;

  /// Bytes when the file was opened.
  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace inslab::files
