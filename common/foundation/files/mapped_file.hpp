#pragma once

#include <cstdint>
#include <string>

namespace inslab::files {

/// A file mapped into memory for reading and writing; what is written survives the process. Private to the user, and to
/// one process at a time.
class MappedFile {
 public:
  /// Opens `path`, or creates it with zeros, at least `size` bytes. Throws std::runtime_error naming the file, also
  /// when another process has it.
  MappedFile(const std::string& path, std::size_t size);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::uint8_t* data() { return data_; }
  std::size_t size() const { return size_; }
  /// Makes it at least `size` bytes long; data() may move. Throws std::runtime_error, and then it is as it was.
  void grow(std::size_t size);

 private:
  void reserve(std::size_t size);
  void map(std::size_t size);

  std::string path_;
  int descriptor_ = -1;
  std::uint8_t* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace inslab::files
