#pragma once

#include <functional>

#include "services/inslab/log_summary.hpp"

namespace inslab::cli {

/// What the profiles of one IMU in use at a time promise for its output minus its truth, as rates, at one sample
/// period.
class ImuPromise {
 public:
  ImuPromise(const LogSummary& summary, const SensorAddress& imu, std::int64_t sim_time_ns, double dt_s);

  /// False when a low-pass filter, the end of the scale or a fault of an axis shapes the output: its spread is then not
  /// that of the noise, and nothing here is promised.
  bool is_plain() const { return is_plain_; }

  /// Standard deviation of the rate error, rad/s, m/s^2: white noise, counts, and vibration as interval means show it.
  double gyro_sigma() const;
  double accel_sigma() const;
  /// The same after first differences over sqrt(2), which pass a frequency f with the power 1 - cos(2 pi f dt).
  double gyro_white_sigma() const;
  double accel_white_sigma() const;

  /// Largest displacement of a moving mount along one axis, m.
  double mount_reach_m() const;

  /// Relative standard error of the spread measured over `duration_s` beyond that of independent values: sinusoids
  /// that are cut off within a period, and random vibration, whose band holds few independent values.
  double spread_error(double duration_s) const;

 private:
  using Gain = std::function<double(double frequency_hz)>;
  double variance(const Vector3& density, const Vector3& count, double vibration, double count_gain) const;
  double linear(const Gain& gain) const;
  double angular(const Gain& gain) const;
  Gain difference_gain() const;

  double dt_s_;
  bool is_plain_ = true;
  Vector3 gyro_density_ = Vector3::Zero();   ///< rad/sqrt(s), the burst of a fault included
  Vector3 accel_density_ = Vector3::Zero();  ///< m/s/sqrt(s)
  Vector3 gyro_count_ = Vector3::Zero();     ///< rad
  Vector3 accel_count_ = Vector3::Zero();    ///< m/s
  VibrationProfile vibration_;
};

}  // namespace inslab::cli
