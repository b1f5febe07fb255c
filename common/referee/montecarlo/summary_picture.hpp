#pragma once

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/montecarlo/summary.hpp"

namespace inslab::montecarlo {

/// How the drift of the runs is distributed, their errors over time beside what the filters believed, and NEES in its
/// band. At least one run succeeded.
tables::Picture summary_picture(const Summary& summary);

}  // namespace inslab::montecarlo
