#pragma once

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::verify {

/// Where the runs of the verification stand in time; none of their figures depends on it.
inline const time::GpsTime kStart{2300, 0};

}  // namespace inslab::verify
