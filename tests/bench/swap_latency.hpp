#pragma once

#include <vector>

#include "tests/bench/chain_block.hpp"

namespace inslab::bench {

/// Sends `count` swaps of IMU 0's error profile to a running set, at random phases of the sample period; for each, the
/// seconds from sending the request to the receipt, in a callback, of the first sample made under it. Throws
/// std::runtime_error when the set fails or a swap does not show within 5 s.
std::vector<double> measure_swap_latency(const ChainSettings& settings, int count);

}  // namespace inslab::bench
