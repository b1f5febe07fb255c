#pragma once

#include "services/inslab/report_page.hpp"
#include "services/inslab/report_pictures.hpp"

namespace inslab::cli {

/// The figures of a report as tables, the most wanted first: acceptance, errors by phase, outages, errors over what was
/// to be expected, what the app did, profiles. Those that would be empty are left out.
std::vector<PageTable> report_tables(const LogScore& score, const LogSummary& summary, const ErrorCurves& curves,
                                     const Expectation& expectation);

}  // namespace inslab::cli
