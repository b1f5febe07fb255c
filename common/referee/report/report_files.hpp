#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "inslab/referee/report/report_data.hpp"
#include "inslab/referee/report/report_page.hpp"

namespace inslab::report {

/// The figures for the terminal; score_words() with what was to be expected.
std::string report_text(const ReportData& data);

/// The same as JSON: score::score_json with the members `run`, `verdict`, `worst`, `swap_intervals` and `expected`.
nlohmann::ordered_json report_json(const ReportData& data);

/// What a log says of the app, with its pictures; the Allan deviation is that of the first IMU less its truth. What
/// cannot be drawn is said in the notes.
ReportPage report_page(const ReportData& data);

/// Writes STEM.txt, STEM.json and STEM.html into the folder, STEM being the log's name, and returns FOLDER/STEM. Throws
/// files::WriteError.
std::string write_report(const ReportData& data, const std::string& folder);

/// The files that write_report() makes of a log of this name in the folder.
std::vector<std::string> report_paths(const std::string& log, const std::string& folder);

}  // namespace inslab::report
