#pragma once

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/profiles/magnetometer_error_profile.hpp"
#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// What the filter is told of a magnetometer of such a profile. Hard iron: root of the sum of squares of the constant,
/// the Gauss-Markov error and the largest of the currents, with the Gauss-Markov error's correlation time (a constant
/// where the profile has none). Soft iron: a constant of each element's size. White: with the share of the counts. The
/// Earth's field is the model's, as it is in a run. Blocks of states are chosen where there is something to estimate.
void match(const MagnetometerErrorProfile& magnetometer, const InstallationProfile& place,
           const InstallationProfile& imu_place, NavigationParameters& parameters);

}  // namespace inslab::navigation
