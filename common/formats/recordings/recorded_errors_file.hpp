#pragma once

#include <map>
#include <string>

#include "inslab/data/samples/recorded_errors.hpp"

namespace inslab::recordings {

/// Writes the errors of an IMU as a log: inslab/imu/0 with the errors in place of increments, so that every tool that
/// reads an IMU's log reads them, and a metadata record "recorded_errors" that says what they are, with `notes` on how
/// they were made. Throws files::WriteError.
void write_recorded_errors(const std::string& path, const RecordedErrors& errors,
                           const std::map<std::string, std::string>& notes);

struct RecordedErrorsFile {
  RecordedErrors errors;
  std::map<std::string, std::string> notes;
};

/// Reads what write_recorded_errors() writes. Throws files::ReadError: no such log, one without the record that says
/// that it holds errors (an IMU's own log would move the vehicle twice), samples that are missing or out of their rate,
/// or more than files::kMaxRowsInMemory.
RecordedErrorsFile read_recorded_errors(const std::string& path);

}  // namespace inslab::recordings
