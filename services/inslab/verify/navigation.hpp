#pragma once

#include <cstdint>

#include "services/inslab/verify/table.hpp"

namespace inslab::verify {

/// Thesis tables 4-10 to 4-13: three IMUs in a car with RTK fixes, outages of 60 s every 120 s: RMS over the outages of
/// each one's largest drift, RMS attitude, from parameters and from a file, beside the thesis's simulated and real
/// columns. A row holds when every figure is within a factor 2 of the thesis's simulated one.
Table outage_table(std::uint64_t seeds);

/// The filter against its own covariance: NEES of position, velocity and attitude and squared innovations, pooled over
/// `runs` seeded runs, inside their 95 % bands.
Table honesty_table(std::uint64_t runs);

/// `inslab verify navigation`: one preset seed and 100 short runs; with `full` 20 seeds.
std::vector<Table> navigation(bool full);

}  // namespace inslab::verify
