#pragma once

#include "inslab/foundation/time/rate.hpp"
#include "inslab/referee/verify/closed_loop_block.hpp"

namespace inslab::verify {

/// Rows of the cases at `row_rate`, `spline`, IMU at 200 Hz, mechanization with the full rotation term and as printed,
/// against the curve; and how far the curve passes from the rows.
Table spline_table(const std::string& title, const std::vector<LoopCase>& cases, const time::Rate& row_rate,
                   const Subjects& subjects = {});

/// Files as they are, by `spline`: how far the curve is from a spline through the same rows that is solved apart from
/// the product's, how far it swings out from the straight lines between the rows, beside the bound that the rows alone
/// set, and how far mechanized increments leave the curve.
Table spline_file_table(const std::vector<std::shared_ptr<const TrajectoryFile>>& files, const Subjects& subjects = {});

}  // namespace inslab::verify
