#pragma once

#include <stdexcept>
#include <string>

namespace inslab::config {

/// A file that cannot be used: which one, where in it, and what was expected instead.
class Error : public std::runtime_error {
 public:
  Error(const std::string& file, const std::string& path, const std::string& reason)
      : std::runtime_error(file + ": " + (path.empty() ? "" : path + ": ") + reason),
        file_(file),
        path_(path),
        reason_(reason) {}

  const std::string& file() const { return file_; }
  const std::string& path() const { return path_; }      ///< such as "sensors.imu[0].rate_hz"; empty: the whole file
  const std::string& reason() const { return reason_; }

 private:
  std::string file_;
  std::string path_;
  std::string reason_;
};

}  // namespace inslab::config
