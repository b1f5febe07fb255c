#pragma once

#include <vector>

#include "inslab/data/profiles/imu_error_profile.hpp"
#include "inslab/models/imu/low_pass.hpp"

namespace inslab::evidence {

/// What the low-pass filter of one axis makes of errors that come with the samples, from the filter itself
/// (imu::Bandwidth): its answer h[k] to one increment. Without a filter h is 1, 0, 0, ...
class FilterResponse {
 public:
  FilterResponse() = default;  ///< no filter
  /// Throws std::invalid_argument for a bandwidth below 0; 0: no filter.
  FilterResponse(double bandwidth_hz, FilterOrder order, double dt_s);

  /// Power that it leaves of a vibration, which it filters in continuous time: |H(f)|^2.
  double vibration_power_at(double frequency_hz) const { return std::norm(low_pass_.response(frequency_hz)); }
  /// Variance that it leaves of white noise of variance 1: the sum of h^2.
  double white_gain() const;
  /// The same after first differences, halved: the sum of (h[k] - h[k-1])^2 / 2.
  double difference_gain() const;
  /// Power that it leaves of what comes with this frequency, sampled: |sum of h[k] exp(-2 pi i f k dt)|^2.
  double power_at(double frequency_hz) const;
  /// Sum over all lags of the squared correlation coefficients of what it makes of white noise, and of its first
  /// differences: n values say as much as n over this many independent ones.
  double white_correlation() const;
  double difference_correlation() const;
  /// How long an answer lasts until less than 1e-6 of it is left, s.
  double settling_s() const { return static_cast<double>(answer_.size()) * dt_s_; }

 private:
  std::vector<double> differences() const;

  double dt_s_ = 0.0;
  imu::LowPass low_pass_;
  std::vector<double> answer_{1.0};
};

}  // namespace inslab::evidence
