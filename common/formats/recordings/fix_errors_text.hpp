#pragma once

#include <string>

#include "inslab/data/samples/recorded_fix_errors.hpp"

namespace inslab::recordings {

/// The usual distance of two of these epochs, of which there are two at least: the median.
time::Nanoseconds usual_interval(const std::vector<RecordedFixErrors::Epoch>& epochs);

/// Writes the errors of a receiver's fixes as a CSV: a line of names, then an epoch a line: time_s, errors of position
/// (north_m, east_m, down_m) and velocity, the standard deviations that the receiver claimed, and its fix type. Throws
/// files::WriteError.
void write_fix_errors(const std::string& path, const RecordedFixErrors& errors);

/// Reads what write_fix_errors() writes. Throws files::ReadError naming file, line and column: other names, a number
/// that is none or not finite, a fix type that there is not, times that do not increase, fewer than two epochs.
RecordedFixErrors read_fix_errors(const std::string& path);

}  // namespace inslab::recordings
