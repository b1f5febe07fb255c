#pragma once

#include "io/picture.hpp"
#include "services/inslab/montecarlo/summary.hpp"

namespace inslab::montecarlo {

/// How the drift of the runs is distributed, their errors over time beside what the filters believed, and NEES in its
/// band. At least one run succeeded.
io::Picture summary_picture(const Summary& summary);

}  // namespace inslab::montecarlo
