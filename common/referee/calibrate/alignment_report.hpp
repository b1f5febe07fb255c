#pragma once

#include <string>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/calibrate/recording.hpp"

namespace inslab::calibrate {

/// The attitude by sample, by second and of the whole span, for people; then how well yaw is known, the tilt's trend,
/// and the gyros that a yaw of a standard deviation of `wanted_yaw_deg` needs.
std::string report_text(const AlignedRecording& aligned, double latitude_deg, double wanted_yaw_deg);

/// That yaw's standard deviation is past kYawWarningDeg, and what it would need; empty when it is not.
std::string warning_text(const AlignedRecording& aligned, double latitude_deg);

/// The first lines that were left out, and how many in all; empty when there were none.
std::string bad_lines_text(const AlignedRecording& aligned);

/// Each second's departure from the mean of the seconds.
tables::Picture seconds_picture(const AlignmentResult& result, const std::string& title);

}  // namespace inslab::calibrate
