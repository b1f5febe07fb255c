#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/foundation/files/input_limits.hpp"

/// `inslab profile import`: error parameters of other simulators and filters as profiles of ours. What differs is units
/// and what a number means: a Gauss-Markov bias may be given by its steady-state sigma, as ours is, or by the density
/// of the noise that drives it, sigma = density sqrt(T/2); white noise by its density or by its deviation at a rate.
namespace inslab::profile_import {

struct ImportOptions {
  std::optional<double> rate_hz;  ///< at which the other program runs, where its file does not say and it matters
  std::string sensor;             ///< of several IMUs in one file, the one of this name
};

struct ImportedProfile {
  ImuErrorProfile profile;
  std::vector<std::string> lines;  ///< for people: each conversion, and what was left out
};

/// The text of a file that a profile is made from. Throws files::ReadError when it cannot be read or is larger than
/// such a file may be (foundation/files/input_limits.hpp).
std::string import_text(const std::string& file);

/// Throws files::ReadError: at `place` the file has more in each other than an import may have.
[[noreturn]] void refuse_depth(const std::string& place, std::size_t levels = files::kMaxImportLevels);

/// "gbstd [0.027 0.027 0.027] deg/h -> gyro.bias_gm_sigma_deg_per_h [...]: the same".
std::string conversion_line(const std::string& from, const Vector3& from_value, const std::string& from_unit,
                            const std::string& to, const Vector3& to_value, const std::string& how);

/// Holds the finished profile to its limits and rules. Throws files::ReadError naming the file and the field at fault.
void check_imported(const std::string& file, const ImuErrorProfile& profile);

/// Each throws files::ReadError naming the file, the line, and what was expected.
///
/// KF-GINS's configuration (YAML): `imunoise`. Its filter drives a bias with 2 sigma^2/T, so gbstd, abstd, gsstd and
/// asstd are steady-state sigmas, all with the one corrtime.
ImportedProfile import_kf_gins(const std::string& file, const ImportOptions& options);

/// gnss-ins-sim's IMU dictionary (Python or JSON). Its bias is driven by sigma sqrt(1 - exp(-2 dt/T)), so b_stability
/// is a steady-state sigma; without a correlation time it is white noise of that deviation a sample, which needs a
/// rate.
ImportedProfile import_gnss_ins_sim(const std::string& file, const ImportOptions& options);

/// The <imu> noise of a Gazebo model (SDF): white noise by its deviation at the update rate, the dynamic bias by the
/// density that drives it. Axes are turned from forward-left-up to forward-right-down.
ImportedProfile import_gazebo(const std::string& file, const ImportOptions& options);

}  // namespace inslab::profile_import
