#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "inslab/foundation/time/rate.hpp"

namespace inslab {

/// The errors of one IMU, recorded once: what its increments had too much, interval after interval without a gap.
/// Interval i goes from rate.at(i) to rate.at(i + 1) of the recording's own time.
struct RecordedErrors {
  static constexpr std::size_t kAxes = 6;
  using Increments = std::array<double, kAxes>;  ///< gyros x y z rad, accelerometers x y z m/s

  time::Rate rate{200.0};
  std::vector<Increments> intervals;
};

/// Finds a recording by the name of its file and its SHA-256. Throws std::runtime_error, naming the file and what is
/// wrong with it.
using RecordingFinder =
    std::function<std::shared_ptr<const RecordedErrors>(const std::string& file, const std::string& sha256)>;

}  // namespace inslab
