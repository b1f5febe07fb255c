#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/models/navigation/navigation_filter.hpp"
#include "inslab/referee/verify/outage_score.hpp"
#include "inslab/referee/verify/subjects.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::verify {

/// One filter in one run against the IMU's truth.
struct NavigationRun {
  std::vector<OutageDrift> outages;
  std::vector<double> nees;         ///< of position, velocity, attitude: 9 degrees, at `nees_at_s`
  std::vector<double> innovations;  ///< of position and of velocity: 3 degrees each
  std::uint64_t rejected = 0;
};

/// An IMU in the trunk and its filter.
struct TestedImu {
  ImuErrorProfile errors;
  ImuErrorProfile believed;  ///< what the filter is told: navigation::matching_parameters() of this
  VibrationProfile vibration;
};

/// A barometer and what the filter is told of it.
struct TestedBarometer {
  BarometerErrorProfile errors;
  BarometerErrorProfile believed;
};

/// An odometer on the rear left wheel, whose filter is told its errors.
struct TestedOdometer {
  OdometerErrorProfile errors;
  Vector3 axis_off_rpy_deg = Vector3::Zero();  ///< of the wheel, beside what the filter is told
  double axis_sigma_deg = 0.3;                 ///< which is as sure as that
  navigation::RollingConstraint constraint = {};
};

/// A receiver with two antennas on the roof, whose filter is told its errors; the baseline leads forward.
struct TestedHeading {
  HeadingErrorProfile errors;
  double baseline_m = 2.0;
};

/// What a run is made of.
struct NavigationSetup {
  std::uint64_t seed = 1;
  std::vector<TestedImu> imus;
  scenario::Trajectory motion;
  std::shared_ptr<const TrajectoryFile> file;  ///< the rows of a motion from a file
  GnssErrorProfile gnss;
  double gnss_rate_hz = 1.0;
  Vector3 antenna_off_v_m = Vector3::Zero();  ///< from where the filter takes the antenna to be
  bool gnss_velocity = false;                 ///< false: positions alone, as 7-column texts have them
  double duration_s = 1200.0;
  OutageTimes outages;
  std::vector<double> shifts_s = {0.0, 60.0, 120.0};  ///< of all outages: the same run anew for each, but for the fixes
  std::vector<double> nees_at_s;                      ///< instants of IMU samples
  bool zero_velocity_updates = false;
  /// Other sensors, at kAidRate_hz; absent: there is none. The magnetometer is at the IMU's place, along its axes.
  std::optional<MagnetometerErrorProfile> magnetometer = std::nullopt;
  std::optional<TestedBarometer> barometer = std::nullopt;
  std::optional<TestedOdometer> odometer = std::nullopt;
  std::optional<TestedHeading> heading = std::nullopt;
};

inline constexpr double kImuRate_hz = 200.0;
inline constexpr double kAidRate_hz = 10.0;
inline constexpr time::GpsTime kNavigationStart{2446, 36000000000000};

/// Every filter begins at the truth plus errors drawn from its initial covariance; the sensors' streams follow from
/// the seed. Receiver n has the outages of shift n.
scenario::LoadedScenario navigation_scenario(const NavigationSetup& setup);

/// What the filter beside an IMU of the setup is told.
navigation::NavigationParameters filter_parameters(const NavigationSetup& setup, std::size_t imu);

/// A run for each IMU of the setup and each shift: those of the first IMU first.
std::vector<NavigationRun> navigate(const NavigationSetup& setup, const Subjects& subjects = {});

}  // namespace inslab::verify
