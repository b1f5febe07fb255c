#pragma once

namespace inslab::nav {

/// A sum that carries its own rounding error: it errs by 2e-16 of the sum of the terms' sizes, however many there are.
///
/// Source: D. Knuth, The Art of Computer Programming 2, 4.2.2, theorem B (the exact error of one addition). Needs
/// arithmetic as written: no -ffast-math.
class CompensatedSum {
 public:
  CompensatedSum() = default;
  explicit CompensatedSum(double value) : high_(value) {}

  void add(double term) {
    const double increment = term + low_;
    const double sum = high_ + increment;
    const double taken = sum - high_;
    low_ = (high_ - (sum - taken)) + (increment - taken);
    high_ = sum;
  }

  /// The nearest double to the sum.
  double value() const { return high_; }

  /// What value() leaves out, below half a unit in its last place.
  double rest() const { return low_; }

 private:
  double high_ = 0.0;
  double low_ = 0.0;
};

}  // namespace inslab::nav
