#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "inslab/referee/verify/aids.hpp"
#include "inslab/referee/verify/outage_figures.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::verify {

/// How much is driven: `navigation` of the command takes all of it.
struct OutageRuns {
  std::uint64_t seeds = 1;
  std::vector<MotionFrom> motions = {MotionFrom::Parameters, MotionFrom::File};
  OutageTimes outages;
  double duration_s = 1200.0;
};

/// Thesis tables 4-10 to 4-13: three IMUs in a car with RTK fixes, outages of 60 s: RMS over the outages of the largest
/// errors in each, beside the thesis's simulated figures. A row holds when every figure is within a factor 2 of the
/// thesis's, either way. With other outages than the thesis's nothing is judged.
Table outage_table(const OutageRuns& runs, const Subjects& subjects = {});

/// The same drives with the terms that the thesis left out, beside its real figures: within a factor 1.5 either way;
/// and how far the thesis's own simulation is from these.
Table beyond_table(const OutageRuns& runs, const Subjects& subjects = {});

/// The drives of the first table from parameters, without and with each of the other sensors: the drift that it is
/// there for, within limits on both sides that follow from the drift without it and its own.
Table aids_table(const OutageRuns& runs, const Subjects& subjects = {});

/// The filter, with another sensor where one is named, against its own covariance: NEES of position, velocity and
/// attitude, the last after an outage, and squared innovations of fixes, pooled over `runs` seeded drives, inside their
/// 95 % bands; with another sensor inside those of 99.9 %, as there are many rows then.
Table honesty_table(std::uint64_t runs, const std::optional<Aid>& aid = std::nullopt, const Subjects& subjects = {});

/// What the figures from parameters become under other readings of what the thesis does not say. Not judged.
Table readings_table(std::uint64_t seeds);

/// `inslab verify navigation`: one preset seed and 100 short drives; with `full` 20 seeds, and the readings. With other
/// outages than the thesis's their table alone.
std::vector<Table> navigation(bool full, const OutageTimes& outages);

}  // namespace inslab::verify
