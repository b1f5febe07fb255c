#pragma once

#include <functional>
#include <string>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::check {

/// A file that is to be read, with all that it names.
struct CheckOptions {
  /// Hears how far a scenario was looked ahead: its name, how long that is, and where it is.
  using Progress = std::function<void(const std::string& name, double span_s, time::Nanoseconds sim_time)>;

  std::string file;
  std::string kind;          ///< empty: as the file's content says
  std::string sensor_kind;   ///< for a profile: the kind of sensor it goes to; empty: the usual one
  bool lists_files = false;  ///< of a scenario: say only which files it takes
  Progress progress;
};

/// What is in a file that was read.
struct FileCheck {
  std::string text;
  bool is_good = true;  ///< a trajectory may break its limits
};

/// Recognises a file by its content, or takes it for what `kind` says, and reads it. Throws json::Error,
/// files::ReadError for what is wrong with it.
FileCheck check_file(const CheckOptions& options);

}  // namespace inslab::check
