#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace inslab::files {

/// SHA-256 (FIPS 180-4) of what is added, piece by piece.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(const void* data, std::size_t size);
  /// With its length, so that what follows cannot be taken for a part of it.
  void add_text(const std::string& text);
  /// The whole of a file. Throws ReadError.
  void add_file(const std::string& path);

  /// 64 digits of what was added; nothing is added afterwards.
  std::string hexadecimal();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

/// Of the whole file alone, as `sha256sum` prints it. Throws ReadError.
std::string sha256_of_file(const std::string& path);

}  // namespace inslab::files
