#pragma once

#include <string>
#include <vector>

#include "inslab/referee/evidence/evidence_lines.hpp"

namespace inslab::evidence {

/// What samples show of a vector in the vehicle on one side of a swap, and what is promised.
struct MeasuredArm {
  const NoiseStatistics& series_v_m;
  Vector3 promised_v_m;
  double error_m = 0.0;  ///< standard error of the mean of each axis
};

/// A line for each axis.
inline std::vector<EvidenceLine> arm_lines(const std::string& name, const MeasuredArm& before,
                                           const MeasuredArm& after) {
  constexpr double kResolution_m = 1e-6;
  static constexpr const char* kAxes[] = {" forward", " right", " down"};
  std::vector<EvidenceLine> lines;
  for (int axis = 0; axis < 3; ++axis) {
    const auto measured = [axis](const MeasuredArm& arm) {
      return judged(arm.series_v_m.mean()[axis], arm.promised_v_m[axis], 4.0 * arm.error_m + kResolution_m);
    };
    lines.push_back({name + kAxes[axis], "m", measured(before), measured(after)});
  }
  return lines;
}

}  // namespace inslab::evidence
