#pragma once

#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/noise/allan/allan_stream.hpp"
#include "inslab/noise/allan/record.hpp"
#include "inslab/referee/verify/subjects.hpp"

namespace inslab::verify {

/// What is kept of one axis of an IMU at rest: enough for its Allan curve and for a fit, in flat memory.
struct AxisRecord {
  allan::Record record;
  std::vector<allan::AllanPoint> curve;
};

/// The outputs of an IMU that lies still on the Earth, from the offline runner: truth model, IMU model and all, with
/// Earth rate and gravity in them. Gyros x y z (rad/s), then accelerometers x y z (m/s^2).
std::vector<AxisRecord> record_still_imu(const ImuErrorProfile& errors, double rate_hz, double duration_s,
                                         std::uint64_t seed, const Simulation& simulation = product_simulation);

}  // namespace inslab::verify
