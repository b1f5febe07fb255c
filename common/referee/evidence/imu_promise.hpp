#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "inslab/referee/evidence/filter_response.hpp"
#include "inslab/referee/evidence/log_summary.hpp"

namespace inslab::evidence {

/// What the profiles of one IMU in use at a time promise for its output minus its truth, as rates, at one sample
/// period.
class ImuPromise {
 public:
  ImuPromise(const LogSummary& summary, const SensorAddress& imu, std::int64_t sim_time_ns, double dt_s);

  /// Why the output's spread is not that of noise and vibration, and nothing here is promised; empty otherwise.
  const std::string& why_not() const { return why_not_; }
  /// Whether a low-pass filter shapes the output.
  bool is_filtered() const { return is_filtered_; }

  /// Standard deviation of the rate error about what ResidualStatistics takes out of so many samples, rad/s, m/s^2:
  /// white noise, flicker and vibration as interval means show it, all through the sensor's low-pass filter, and
  /// counts, which come after it.
  double gyro_sigma(std::uint64_t samples) const;
  double accel_sigma(std::uint64_t samples) const;
  /// Four standard errors of them that flicker, whose power lies in few slow waves, adds.
  double gyro_sigma_error(std::uint64_t samples) const { return sigma_error(gyro_, gyro_sigma(samples)); }
  double accel_sigma_error(std::uint64_t samples) const { return sigma_error(accel_, accel_sigma(samples)); }
  /// The same after first differences over sqrt(2), which pass a frequency f with the power 1 - cos(2 pi f dt).
  double gyro_white_sigma() const;
  double accel_white_sigma() const;

  /// Neighbours are alike behind a filter: n values, or n first differences, tell as much of their spread as n over
  /// this many independent ones.
  double values_per_independent() const { return white_correlation_; }
  double differences_per_independent() const { return difference_correlation_; }

  /// Largest displacement of a moving mount along one axis, m.
  double mount_reach_m() const;

  /// Relative standard error of the spread measured over `duration_s` beyond that of independent values: sinusoids
  /// that are cut off within a period, and random vibration, whose band holds few independent values.
  double spread_error(double duration_s) const;

 private:
  struct Triad {
    Vector3 density = Vector3::Zero();      ///< rad/sqrt(s) | m/s/sqrt(s), the burst of a fault included
    Vector3 count = Vector3::Zero();        ///< rad | m/s
    Vector3 instability = Vector3::Zero();  ///< B of the flicker, rad/s | m/s^2
    std::array<FilterResponse, 3> filter;
  };
  enum class Of { Values, Differences };

  void take(const ImuErrorProfile& errors);
  void take(const FaultProfile& fault);
  double variance(const Triad& triad, double vibration, Of of, double flicker_per_B2) const;
  static double sigma_error(const Triad& triad, double sigma);
  double linear(Of of) const;
  double angular(Of of) const;
  double passed(const Triad& triad, const Vector3& power, double frequency_hz, Of of) const;

  double dt_s_;
  std::string why_not_;
  bool is_filtered_ = false;
  double white_correlation_ = 1.0;
  double difference_correlation_ = 1.0;
  Triad gyro_;
  Triad accel_;
  VibrationProfile vibration_;
};

}  // namespace inslab::evidence
