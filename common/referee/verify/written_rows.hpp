#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/formats/recordings/nav_text.hpp"

namespace inslab::verify {

/// Rows that go through a text of 11 columns in the temporary folder, which is gone with this object: what a user's
/// file keeps of them.
class WrittenRows {
 public:
  /// Throws files::WriteError.
  explicit WrittenRows(const std::string& name);
  WrittenRows(const WrittenRows&) = delete;
  WrittenRows& operator=(const WrittenRows&) = delete;
  ~WrittenRows();

  /// Throws files::WriteError.
  void add(const time::GpsTime& time, const TrajectoryRow& row) { text_.write(time, row); }

  /// After the last row. Throws json::Error when a row breaks a rule of trajectory files.
  std::shared_ptr<const TrajectoryFile> read();

 private:
  std::string name_;
  std::filesystem::path path_;
  recordings::NavTextWriter text_;
};

}  // namespace inslab::verify
