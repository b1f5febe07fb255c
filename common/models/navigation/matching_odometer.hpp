#pragma once

#include "inslab/data/profiles/installation_profile.hpp"
#include "inslab/data/profiles/odometer_error_profile.hpp"
#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// What the filter is told of the odometer of that number, `odometer` or `other_odometer` of the parameters; of another
/// nothing. Scale factor: the constant and what is drawn once by root of the sum of squares, beside it what drifts, the
/// Gauss-Markov error and a tyre that warms. Slip: the tyre's curve, as a standard deviation. Wheels' axes keep the
/// default uncertainty of what the app is told.
void match(const OdometerErrorProfile& odometer, const InstallationProfile& place, const InstallationProfile& imu_place,
           NavigationParameters& parameters);

}  // namespace inslab::navigation
