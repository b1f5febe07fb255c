#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab {

/// The errors of one GNSS receiver's fixes, recorded once, with its outages: epochs without a fix are not there.
struct RecordedFixErrors {
  struct Epoch {
    time::Nanoseconds time{0};  ///< since the first epoch; increases
    Vector3 position_ned_m = Vector3::Zero();
    Vector3 velocity_ned_m_per_s = Vector3::Zero();
    Vector3 position_sigma_ned_m = Vector3::Zero();        ///< as the receiver claimed them
    Vector3 velocity_sigma_ned_m_per_s = Vector3::Zero();  ///< the same
    FixType fix_type = FixType::Single;
  };

  time::Nanoseconds interval{0};  ///< from epoch to epoch where none is missing
  std::vector<Epoch> epochs;
};

/// Finds a recording by the name of its file and its SHA-256. Throws std::runtime_error, naming the file and what is
/// wrong with it.
using FixRecordingFinder =
    std::function<std::shared_ptr<const RecordedFixErrors>(const std::string& file, const std::string& sha256)>;

}  // namespace inslab
