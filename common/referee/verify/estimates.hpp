#pragma once

#include <cmath>
#include <vector>

namespace inslab::verify {

/// Pools independent estimates of one quantity: their mean, and its standard error from their own spread.
class Estimates {
 public:
  void add(double value) { values_.push_back(value); }
  std::size_t count() const { return values_.size(); }
  const std::vector<double>& values() const { return values_; }

  double mean() const {
    double sum = 0.0;
    for (const double value : values_) sum += value;
    return sum / static_cast<double>(values_.size());
  }
  /// At least two estimates.
  double standard_error() const {
    const double centre = mean();
    double sum = 0.0;
    for (const double value : values_) sum += (value - centre) * (value - centre);
    const auto n = static_cast<double>(values_.size());
    return std::sqrt(sum / (n - 1.0) / n);
  }

 private:
  std::vector<double> values_;
};

}  // namespace inslab::verify
