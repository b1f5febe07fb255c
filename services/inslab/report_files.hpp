#pragma once

#include <string>

#include "services/inslab/report_page.hpp"
#include "services/inslab/score_log.hpp"

namespace inslab::cli {

/// Writes a whole file. Throws io::WriteError.
void write_text_file(const std::string& path, const std::string& text);

/// What a log says of the app, with its pictures; the Allan deviation is that of the first IMU less its truth. What
/// cannot be drawn is said in the notes.
ReportPage report_page(const io::McapReader& log, const LogSummary& summary);

}  // namespace inslab::cli
