#pragma once

#include <string>

#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/data/samples/recorded_fix_errors.hpp"
#include "inslab/formats/trajectory/trajectory_reader.hpp"

namespace inslab::graft {

/// What the errors of a receiver's fixes are to be taken out of.
struct FixErrorOptions {
  std::string file;                 ///< a log of ours, or positions as `inslab trajectory check` reads them
  std::uint32_t sensor_number = 0;  ///< of a log
  std::string columns;              ///< of a text without names
  std::string reference;            ///< where the vehicle was, with attitudes; of a log by default its own truth
  trajectory::TrajectoryReadOptions reference_reading;
  FixType fix_type = FixType::Single;                 ///< of a text, which does not say
  double time_offset_s = 0.0;                         ///< of the reference's time at the same instant: to begin with
  nav::Vector3 lever_arm_v_m = nav::Vector3::Zero();  ///< from the reference's point to the antenna: to begin with
  bool keep_geometry = false;                         ///< both are known: do not fit them
};

struct FixErrors {
  RecordedFixErrors errors;
  std::string text;  ///< for people
};

/// The errors of the fixes against the reference: position in NED at the antenna, velocity where the file has one. Time
/// offset and lever arm come from least squares with a constant error in NED beside them, and with what is known
/// beforehand (0.1 s and 5 m); the constant error stays with the signal. What the receiver claims is taken from a log;
/// of a text it is what the errors spread. Throws files::ReadError naming file and reason.
FixErrors extract_fix_errors(const FixErrorOptions& options);

/// The profile that puts a recording onto a simulated receiver. Throws files::ReadError.
GnssErrorProfile fix_profile_of(const std::string& recording_file);

}  // namespace inslab::graft
