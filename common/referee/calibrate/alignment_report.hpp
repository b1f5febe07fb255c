#pragma once

#include <string>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/calibrate/recording.hpp"

namespace inslab::calibrate {

/// The attitude by sample, by second and of the whole span, for people.
std::string report_text(const AlignedRecording& aligned);

/// The first lines that were left out, and how many in all; empty when there were none.
std::string bad_lines_text(const AlignedRecording& aligned);

/// Each second's departure from the mean of the seconds.
tables::Picture seconds_picture(const AlignmentResult& result, const std::string& title);

}  // namespace inslab::calibrate
