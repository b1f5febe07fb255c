#pragma once

#include "inslab/data/profiles/heading_error_profile.hpp"
#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// What the filter is told of a receiver with two antennas of such a profile: the nominal arms in the IMU's axes, white
/// noise and multipath of its best solution, which alone is used. Multipath is estimated where there is any.
void match(const HeadingErrorProfile& heading, const InstallationProfile& place, const InstallationProfile& imu_place,
           NavigationParameters& parameters);

}  // namespace inslab::navigation
