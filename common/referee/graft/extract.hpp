#pragma once

#include <map>
#include <optional>
#include <string>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/data/samples/recorded_errors.hpp"
#include "inslab/formats/recordings/imu_recording.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"
#include "inslab/referee/graft/geometry_fit.hpp"
#include "inslab/referee/graft/motion_terms.hpp"
#include "inslab/referee/graft/still_errors.hpp"

namespace inslab::graft {

/// What the errors are to be taken out of.
struct ExtractOptions {
  std::string file;
  recordings::ImuRecordingOptions recording;  ///< with minus_truth: of a log of ours, which holds the perfect IMU
  std::optional<StillSite> site;              ///< the IMU stood still there
  std::string reference;                      ///< or it moved along the trajectory of this file
  trajectory::TrajectoryReadOptions reference_reading;
  Geometry start;              ///< of the reference's fit
  bool keep_geometry = false;  ///< it is known: `start` is not fitted
};

/// Errors taken out of a recording, and how.
struct Extracted {
  RecordedErrors errors;
  std::map<std::string, std::string> notes;  ///< for the file
  std::string text;                          ///< for people
  std::optional<MotionTerms> terms;          ///< of a moving recording: what was taken out of the errors
};

/// Throws files::ReadError naming file and reason, std::runtime_error where the geometry does not settle.
Extracted extract(const ExtractOptions& options);

/// The profile that puts a recording onto a simulated IMU: `full` with the terms that go with the motion, otherwise the
/// signal alone. Throws files::ReadError when the file cannot be read.
ImuErrorProfile profile_of(const std::string& recording_file, const std::optional<MotionTerms>& full);

/// What a file of recorded errors holds: how it was made, its length, and each axis' mean and spread. Throws
/// files::ReadError.
std::string recording_text(const std::string& recording_file);

}  // namespace inslab::graft
