#pragma once

#include <cstdint>
#include <vector>

#include "inslab/data/samples/recorded_errors.hpp"
#include "inslab/data/samples/trajectory_file.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::graft {

/// How a recorded IMU sat on the reference, and how its clock went beside the reference's.
struct Geometry {
  double time_offset_s = 0.0;                            ///< of the reference's time at the same instant
  nav::Vector3 mounting_rpy_rad = nav::Vector3::Zero();  ///< roll, pitch, yaw of C_vb
  nav::Vector3 lever_arm_v_m = nav::Vector3::Zero();     ///< from the reference's point to the IMU
};

/// A perfect IMU carried along the trajectory of a reference: smooth curves through its rows.
class ReferenceImu {
 public:
  /// `first_ns`: the end of interval 0 of the recorded IMU; `count` intervals at `rate`. Both times are of the same
  /// zero, or of a GPS week. Throws files::ReadError when the rows lack attitude, or overlap less than ten seconds.
  ReferenceImu(TrajectoryFile reference, const time::Rate& rate, std::int64_t first_ns, std::size_t count);

  const time::Rate& rate() const { return rate_; }
  /// Intervals of the recording that the reference covers, with a second to spare at both ends.
  std::size_t first() const { return first_; }
  std::size_t count() const { return count_; }

  /// The perfect increments of those intervals. Throws std::domain_error where the reference leaves the domain of
  /// geodesy, std::out_of_range for a time offset beyond a second.
  std::vector<RecordedErrors::Increments> increments(const Geometry& geometry) const;

 private:
  std::int64_t row_time_ns(std::size_t interval_end) const;

  TrajectoryFile reference_;
  time::Rate rate_;
  std::int64_t begin_ns_;  ///< of interval 0, in the reference's time from its first row on
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace inslab::graft
