#pragma once

#include "inslab/data/profiles/barometer_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// What the filter is told of a barometer of such a profile; pascals become metres as at sea level. The constant bias:
/// root of the sum of squares of the geoid's height, the pressure at sea level less the standard's, and the offset. The
/// weather's drift: the Gauss-Markov one and ten minutes of the rate. The sensor's: its Gauss-Markov error. Scale of
/// heights: the temperature's deviation and its drift over the standard's, as a constant. White: with the share of the
/// counts. Blocks of states are chosen where there is something to estimate.
void match(const BarometerErrorProfile& barometer, const InstallationProfile& place,
           const InstallationProfile& imu_place, NavigationParameters& parameters);

}  // namespace inslab::navigation
