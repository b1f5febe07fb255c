#pragma once

#include "inslab/data/json/json_file.hpp"
#include "inslab/referee/montecarlo/summary.hpp"

namespace inslab::montecarlo {

/// The figures that most readers want, each with its interval in brackets.
std::string summary_text(const Summary& summary);

/// Every figure. A bound that is absent is null.
json::Json summary_json(const Summary& summary);

}  // namespace inslab::montecarlo
