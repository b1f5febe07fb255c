#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace inslab::io {

/// A file that grows by whole pieces: a piece is in the file entirely or not at all.
///
/// Bytes go straight to the kernel, so they survive a killed process. A file size limit raises SIGXFSZ, which ends the
/// process unless it is ignored; processes that write logs ignore it and get EFBIG here.
class OutputFile {
 public:
  /// Creates or empties the file. Throws WriteError.
  explicit OutputFile(const std::string& path);
  /// Goes on with a file that is there, after its first `keep` bytes; the rest is cut off. Throws WriteError.
  OutputFile(const std::string& path, std::uint64_t keep);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Adds `size` bytes. On an error of the disk takes back what was written of them and throws WriteError.
  void append(const std::uint8_t* data, std::size_t size);

  /// Hands everything to the disk and closes. Throws WriteError.
  void close();

  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

}  // namespace inslab::io
