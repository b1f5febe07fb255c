#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "inslab/data/samples/recorded_errors.hpp"
#include "inslab/data/samples/recorded_fix_errors.hpp"

namespace inslab::recordings {

/// The folder of recordings of one host. Profiles name a file in it and its SHA-256, never a path, so that a profile
/// that comes over the network opens nothing else, and means the same signal on every host. What was read stays.
class RecordingShelf {
 public:
  explicit RecordingShelf(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Errors of an IMU, and of a receiver. Both throw files::ReadError naming the file: a name that leads elsewhere, no
  /// such file, another SHA-256 than the one given, and what read_recorded_errors() and read_fix_errors() refuse.
  std::shared_ptr<const RecordedErrors> find_imu(const std::string& file, const std::string& sha256);
  std::shared_ptr<const RecordedFixErrors> find_fixes(const std::string& file, const std::string& sha256);

 private:
  std::string checked_path(const std::string& file, const std::string& sha256) const;

  std::filesystem::path folder_;
  std::map<std::string, std::shared_ptr<const RecordedErrors>> imus_;  ///< by SHA-256
  std::map<std::string, std::shared_ptr<const RecordedFixErrors>> fixes_;
};

}  // namespace inslab::recordings
