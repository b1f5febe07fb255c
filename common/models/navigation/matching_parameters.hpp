#pragma once

#include <string>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// The parameters of the filter that matches an IMU: what the profile says at random is what the filter believes.
///
/// Bias: root of the sum of squares of the constant, turn-on, Gauss-Markov and bias-instability terms, an hour of the
/// random walk, what the course of the temperature does at most, and for gyros what 1 g does, whichever way it points;
/// with the Gauss-Markov term's correlation time (a constant where the profile has none). Scale factor likewise, with
/// the non-linearity, asymmetry and cross-axis terms, which a filter of 21 states has no other place for. The lever arm
/// leads from the IMU to the antenna in the IMU's axes. All else keeps its default. What is left out, and
/// why, is declared in matching_uses.hpp.
NavigationParameters matching_parameters(const ImuErrorProfile& imu, const InstallationProfile& imu_place,
                                         const InstallationProfile& antenna_place);

/// Names of what a profile of the unit sets and the matching parameters leave out.
std::vector<std::string> left_out_of_matching(const catalog::AnyProfile& profile);

}  // namespace inslab::navigation
