#pragma once

#include <limits>
#include <vector>

#include "inslab/referee/verify/subjects.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// Block 1 of the verification, the truth of motion tables: each scenario of the catalogue, over its whole length or
/// its first `longest_s`, against an independent solution (ecef_reference.hpp), and its smoothness where segments meet.
/// Nothing is random.
std::vector<Table> verify_trajectory(const Subjects& subjects = {},
                                     double longest_s = std::numeric_limits<double>::infinity());

}  // namespace inslab::verify
