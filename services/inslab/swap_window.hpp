#pragma once

#include <map>
#include <optional>

#include "samples/gnss_fix.hpp"
#include "samples/imu_truth.hpp"
#include "samples/truth_state.hpp"
#include "services/inslab/log_summary.hpp"
#include "services/inslab/noise_statistics.hpp"

namespace inslab::cli {

/// A stretch of sim time under the same profiles of one sensor, and what its samples show.
struct SwapWindow {
  std::int64_t after_ns = 0;  ///< samples later than this
  std::int64_t until_ns = 0;  ///< and not later than this
  bool contains(std::int64_t t) const { return t > after_ns && t <= until_ns; }

  NoiseStatistics gyro_rad_per_s;  ///< ImuSample minus ImuTruth, as a rate
  NoiseStatistics accel_m_per_s2;
  NoiseStatistics imu_arm_v_m;     ///< place of the IMU in the vehicle, from both truths
  NoiseStatistics position_ned_m;  ///< GnssFix minus the antenna's truth under the promised arm
  NoiseStatistics velocity_ned_m_per_s;
  NoiseStatistics antenna_arm_v_m;  ///< GnssFix minus the vehicle's truth, in the vehicle's axes
};

/// The windows before and after an acknowledged swap. Nothing when the ack is a rejection.
struct SwapWindows {
  ProfileAck ack;
  const AnyProfile* profile = nullptr;
  SwapWindow before;
  SwapWindow after;
  std::optional<std::uint64_t> first_sequence_seen;  ///< of the first sample with the ack's revision
};

/// Cuts the windows: up to 20 s each way, not over another swap of the same sensor, without the fade of a vibration.
std::vector<SwapWindows> cut_windows(const LogSummary& summary);

/// Puts one IMU interval, or one fix with the vehicle's truth at its time, into the windows it belongs to.
void add_imu(std::vector<SwapWindows>& windows, const ImuSample& sample, const ImuTruth& imu_truth,
             const TruthState& vehicle);
void add_fix(std::vector<SwapWindows>& windows, const GnssFix& fix, const TruthState& vehicle,
             const LogSummary& summary);

}  // namespace inslab::cli
