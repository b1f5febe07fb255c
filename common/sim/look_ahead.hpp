#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "inslab/scenario/load.hpp"

namespace inslab::sim {

/// A value and the sim time of it.
struct Extreme {
  double value = 0.0;
  double at_s = 0.0;
};

/// A triad of an IMU that puts out less than what acts on it.
struct OverScale {
  std::uint32_t imu = 0;
  bool is_gyro = true;
  int axis = 0;             ///< of the largest
  double full_scale = 0.0;  ///< deg/s | g, of that axis
  Extreme largest;          ///< deg/s | g, the interval's true mean
  double first_s = 0.0;
  std::uint64_t samples = 0;
};

/// Whether the reference navigation filter begins.
struct FilterOutlook {
  std::optional<double> begins_s;
  double heading_sigma_deg = 0.0;  ///< when it begins
  double tilt_sigma_deg = 0.0;
  std::string why_not;           ///< when it does not
  bool begins_levelled = false;  ///< with a yaw given and roll and pitch from gravity it would: the vehicle rests
};

/// What a run of the scenario will meet.
struct LookAhead {
  double span_s = 0.0;  ///< how much of the run was looked at
  Extreme lowest_m;
  Extreme highest_m;
  Extreme speed_m_per_s;
  Extreme specific_force_m_per_s2;
  Extreme rate_deg_per_s;
  std::vector<OverScale> over_scale;
  std::optional<FilterOutlook> filter;  ///< nothing when the scenario has no IMU or no receiver
};

/// Runs the scenario without DDS and with the reference navigation filter, on the sensors that the scenario gives it or
/// else on the first of each, up to `longest_s`; `progress` is called now and then with the sim time. Throws
/// std::domain_error, naming time, quantity and limits, when the vehicle leaves the valid domain.
LookAhead look_ahead(scenario::LoadedScenario scenario, double longest_s,
                     const std::function<void(time::Nanoseconds)>& progress = {});

/// The lines of it, a warning for whatever speaks against a run.
std::string text_of(const LookAhead& ahead);

}  // namespace inslab::sim
