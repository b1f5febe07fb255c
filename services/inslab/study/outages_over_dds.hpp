#pragma once

#include "inslab/bus/service/service_options.hpp"
#include "inslab/referee/verify/outage_score.hpp"
#include "inslab/referee/verify/table.hpp"

namespace inslab::study {

/// The outage protocol of `verify navigation` through the real processes: for each IMU and motion a set in lockstep,
/// with the reference navigation app on the bus, and beside it the same scenario in one process without DDS. A row
/// holds when every solution is the same to the bit and no figure is worse than twice the thesis's. Throws
/// std::runtime_error when a run fails.
verify::Table outages_over_dds(const service::NetworkOptions& network, const verify::OutageTimes& outages);

}  // namespace inslab::study
