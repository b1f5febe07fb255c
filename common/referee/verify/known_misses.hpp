#pragma once

#include "inslab/referee/verify/outage_figures.hpp"

namespace inslab::verify {

enum class Side { Below, Above };

/// What the figures of `verify navigation` are held against.
enum class Against { Simulated, Measured };

/// Whether it is known and written down, in docs/verification.md with the reason, that this figure (an index of
/// kDriftNames) of this IMU is outside its limits on that side, by at most half as much again as is written there
/// (other seeds). `by`: above 1, how many times it lies beyond the limit. The row then says MISS, and the command does
/// not fail for it; whatever else is outside fails.
bool is_known_miss(Against against, const char* imu, std::size_t figure, Side side, double by);

}  // namespace inslab::verify
