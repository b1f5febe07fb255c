#pragma once

#include <cmath>
#include <cstdint>

#include "inslab/foundation/fields/field.hpp"

namespace inslab::evidence {

/// Running mean and rms of first differences of a vector series.
class NoiseStatistics {
 public:
  /// `index` counts the samples of the series; first differences are taken between neighbours only.
  void add(std::uint64_t index, const Vector3& value) {
    if (count_ > 0 && index == last_index_ + 1) {
      const Vector3 difference = value - last_;
      difference_squares_ += difference.cwiseProduct(difference);
      ++differences_;
    }
    if (count_ == 0) origin_ = value;
    sum_ += value - origin_;
    ++count_;
    last_ = value;
    last_index_ = index;
  }

  std::uint64_t count() const { return count_; }
  std::uint64_t differences() const { return differences_; }
  Vector3 mean() const { return origin_ + sum_ / static_cast<double>(count_); }

  /// Standard deviation of the white part over the axes chosen by `mask` (1 or 0 each), pooled: the rms of first
  /// differences over sqrt(2). Slow errors drop out.
  double pooled_white_sigma(const Vector3& mask) const {
    return std::sqrt(difference_squares_.dot(mask) / (2.0 * static_cast<double>(differences_) * mask.sum()));
  }

 private:
  Vector3 origin_ = Vector3::Zero();
  Vector3 last_ = Vector3::Zero();
  Vector3 sum_ = Vector3::Zero();
  Vector3 difference_squares_ = Vector3::Zero();
  std::uint64_t last_index_ = 0;
  std::uint64_t count_ = 0;
  std::uint64_t differences_ = 0;
};

}  // namespace inslab::evidence
