#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "inslab/foundation/files/output_place.hpp"

namespace inslab::files {

/// A file that grows by whole pieces: a piece is in the file entirely or not at all. A result has its name when it is
/// closed, and until then what had the name before has it (foundation/files/output_place.hpp); a log grows under its
/// own.
///
/// Bytes go straight to the kernel, so they survive a killed process. A file size limit raises SIGXFSZ, which ends the
/// process unless it is ignored; processes that write logs ignore it and get EFBIG here.
class OutputFile {
 public:
  enum class Kind { Result, Log };

  /// Throws WriteError; OutputRefused when the rule for outputs forbids it or another process writes to the file.
  explicit OutputFile(const std::string& path, Kind kind = Kind::Result);
  /// Goes on with a file that is there, after its first `keep` bytes; the rest is cut off. Throws WriteError.
  OutputFile(const std::string& path, std::uint64_t keep);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Adds `size` bytes. On an error of the disk takes back what was written of them and throws WriteError.
  void append(const std::uint8_t* data, std::size_t size);

  /// Hands everything to the disk, closes, and gives a result its name. Without it a result is gone. Throws WriteError.
  void close();

  std::uint64_t size() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  void claim();

  std::string path_;
  std::optional<OutputPlace> place_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Writes a whole result. Throws WriteError.
void write_file(const std::string& path, std::string_view bytes);

}  // namespace inslab::files
