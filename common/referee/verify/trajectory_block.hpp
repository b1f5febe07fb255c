#pragma once

#include <vector>

#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// Block 1 of the verification, the truth of motion tables: each scenario of the catalogue over its whole length
/// against an independent solution (ecef_reference.hpp), and its smoothness where segments meet. Nothing is random, so
/// `full` changes nothing.
std::vector<Table> verify_trajectory(bool full);

}  // namespace inslab::verify
