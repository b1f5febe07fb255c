#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "inslab/referee/verify/navigation_runs.hpp"

namespace inslab::verify {

/// Of an IMU's outages: horizontal m, vertical m, roll deg, pitch deg, yaw deg.
using DriftFigures = std::array<double, 5>;
inline constexpr std::array<const char*, 5> kDriftNames{"horizontal", "vertical", "roll", "pitch", "yaw"};

/// What the thesis found of an IMU.
struct PublishedDrift {
  const char* imu;  ///< its profiles are imu/NAME_thesis and imu/NAME_full
  DriftFigures from_parameters;
  DriftFigures from_file;
  DriftFigures real;
};
/// Thesis tables 4-11 to 4-13: the navigation-grade IMU and the two MEMS.
const std::array<PublishedDrift, 3>& published_drifts();

/// Where the motion comes from: the catalogue's car, or the file of a drive through a town.
enum class MotionFrom { Parameters, File };

const char* name_of(MotionFrom motion);

/// What the thesis's simulation found with such a motion.
const DriftFigures& simulated(const PublishedDrift& published, MotionFrom motion);

/// Figure by figure.
DriftFigures ratios(const DriftFigures& found, const DriftFigures& expected);

/// The thesis's outages (docs/navigation.md says which of it is from where): its IMUs as it simulates them in 20
/// minutes of driving after a rest, RTK positions at 1 Hz with white noise, outages of 60 s every 180 s from 420 s on,
/// three times over. Each filter is told its IMU's errors.
/// Other outages come three times over likewise, a third of their spacing apart.
NavigationSetup thesis_setup(std::uint64_t seed, MotionFrom motion, const OutageTimes& outages = {});

/// The same drive with what the thesis left out: terms of data sheets and papers, a vibrating car, RTK positions whose
/// errors last. Each filter is told its IMU's noise, and as an unknown bias what the data sheet lets warming and
/// gravity do.
NavigationSetup full_setup(std::uint64_t seed, MotionFrom motion);

/// RMS over the outages of the largest error in each.
DriftFigures drift_of(const std::vector<NavigationRun>& runs);

/// That of every IMU of the setups, over seeds 1 to `seeds`.
std::vector<DriftFigures> drifts(std::uint64_t seeds, const std::function<NavigationSetup(std::uint64_t seed)>& setup,
                                 const Subjects& subjects = {});

/// "0.545 / 0.112; 0.0013 0.0014 0.0129"
std::string text_of(const DriftFigures& figures);

/// The same of ratios: "0.38 0.82; 0.44 0.42 0.25".
std::string ratios_text(const DriftFigures& ratios);

}  // namespace inslab::verify
