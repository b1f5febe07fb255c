#pragma once

#include <cstdint>

#include "inslab/referee/verify/outage_figures.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// Thesis tables 4-10 to 4-13: three IMUs in a car with RTK fixes, outages of 60 s: RMS over the outages of the largest
/// errors in each, from parameters, from a file or both, beside the thesis's simulated figures. A row holds when no
/// figure is more than twice the thesis's; one below half of it is named. With other outages than the thesis's nothing
/// is judged.
Table outage_table(std::uint64_t seeds, const std::vector<MotionFrom>& motions, const OutageTimes& outages = {});

/// The same drives with the terms that the thesis left out, beside its real figures: how far the thesis's simulation
/// and ours are from these. Not judged.
Table beyond_table(std::uint64_t seeds);

/// The filter against its own covariance: NEES of position, velocity and attitude, the last after an outage, and
/// squared innovations, pooled over `runs` seeded drives, inside their 95 % bands.
Table honesty_table(std::uint64_t runs);

/// What the figures from parameters become under other readings of what the thesis does not say. Not judged.
Table readings_table(std::uint64_t seeds);

/// `inslab verify navigation`: one preset seed and 100 short drives; with `full` 20 seeds, and the readings. With other
/// outages than the thesis's their table alone.
std::vector<Table> navigation(bool full, const OutageTimes& outages);

}  // namespace inslab::verify
