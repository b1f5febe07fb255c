#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/trajectory_file.hpp"
#include "scenario/load.hpp"
#include "services/reference_nav/navigation_filter.hpp"

namespace inslab::verify {

/// Errors of the solution in one GNSS outage.
struct OutageDrift {
  double horizontal_m = 0.0;  ///< largest
  double vertical_m = 0.0;    ///< largest
};

/// One filter in one run against the IMU's truth.
struct NavigationRun {
  std::vector<OutageDrift> outages;
  Vector3 attitude_rms_rad = Vector3::Zero();  ///< roll, pitch, yaw, from the first outage on
  double horizontal_rms_m = 0.0;               ///< from the first outage on, or over the run without one
  std::vector<double> nees;                    ///< of position, velocity, attitude: 9 degrees, at `nees_times`
  std::vector<double> innovations;             ///< of position and of velocity: 3 degrees each
  std::uint64_t rejected = 0;
};

/// What a run is made of.
struct NavigationSetup {
  std::uint64_t seed = 1;
  std::vector<ImuErrorProfile> imus;  ///< all in the trunk, each with a filter that matches it
  double duration_s = 1200.0;
  double first_outage_s = 420.0;                   ///< 60 s long, every 120 s; beyond the duration: none
  std::shared_ptr<const io::TrajectoryFile> file;  ///< the motion by inverse mechanization of it; null: the table
  double gnss_rate_hz = 5.0;
  bool gnss_velocity = true;  ///< false: positions alone, as the 7-column text has them
  double nees_every_s = 0.0;  ///< 0: not wanted
  bool zero_velocity_updates = false;
};

inline constexpr double kOutage_s = 60.0;
inline constexpr double kOutageSpacing_s = 120.0;

/// The catalogue's car with RTK fixes at 5 Hz that are always fixed. Every filter begins at the truth plus errors drawn
/// from its initial covariance; the sensors' streams follow from the seed.
scenario::LoadedScenario navigation_scenario(const NavigationSetup& setup);

/// One run for each IMU of the setup.
std::vector<NavigationRun> navigate(const NavigationSetup& setup);

/// The car's motion as a file of 11 columns at 200 Hz, written and read.
std::shared_ptr<const io::TrajectoryFile> car_as_file(double duration_s);

}  // namespace inslab::verify
