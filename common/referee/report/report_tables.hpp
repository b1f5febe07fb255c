#pragma once

#include "inslab/referee/report/report_files.hpp"
#include "inslab/referee/report/report_page.hpp"

namespace inslab::report {

/// The figures of a report as tables, the most wanted first: acceptance, errors by phase, outages, errors over what was
/// to be expected, what the app did, swaps with what was measured before and after them, profiles. Those that would be
/// empty are left out.
std::vector<PageTable> report_tables(const ReportData& data);

}  // namespace inslab::report
