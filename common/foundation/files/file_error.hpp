#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace inslab::files {

/// A file that cannot be read, or does not hold what it should: names the file, the place and what was expected.
class ReadError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  /// Malformed bytes at `offset` of the file.
  ReadError(const std::string& path, std::uint64_t offset, const std::string& expected)
      : std::runtime_error(path + ": at byte " + std::to_string(offset) + ": expected " + expected) {}
};

/// A file that cannot be written: names the file and what the system said.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;

  /// `action` failed with `error_number` (an errno value).
  WriteError(const std::string& path, const std::string& action, int error_number);
};

/// A file that must not be written: it is an input, or a result that nobody asked to replace. Nothing was done.
class OutputRefused : public WriteError {
 public:
  using WriteError::WriteError;
};

}  // namespace inslab::files
