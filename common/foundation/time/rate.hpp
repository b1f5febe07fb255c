#pragma once

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::time {

/// The grid of a stream: instant k is the whole nanosecond nearest to k / rate, found from k alone with whole numbers,
/// so it cannot drift. Intervals of a rate such as 300 Hz differ by a nanosecond among themselves; those of a rate
/// whose period is a whole number of nanoseconds do not.
class Rate {
 public:
  /// The rate is the simplest fraction that the double stands for: 300 is 300/1, 29.97 is 2997/100,
  /// 33.333333333333336 is 100/3. Throws std::invalid_argument unless 1e-3 <= hz <= 1e6.
  explicit Rate(double hz);

  double hz() const { return hz_; }
  /// The nearest whole nanosecond to one period: for display and patience. Instants come from at().
  Nanoseconds period() const { return period_; }
  /// Mean length of an interval, s.
  double period_s() const { return period_s_; }

  /// The rate is samples() in seconds(), whole numbers without a common divisor; both below 2^63.
  std::int64_t samples() const { return samples_; }
  std::int64_t seconds() const { return seconds_; }

  /// Instant k. Exact while it lies within 292 years.
  Nanoseconds at(std::uint64_t k) const;
  /// The last instant that is not after `t`, t >= 0: at(index(t)) <= t < at(index(t) + 1).
  std::uint64_t index(Nanoseconds t) const;
  /// Whether `t`, at least 0, is an instant.
  bool contains(Nanoseconds t) const { return is_whole_ ? t.count() % period_.count() == 0 : at(index(t)) == t; }

 private:
  double hz_;
  Nanoseconds period_{0};
  double period_s_ = 0.0;
  bool is_whole_ = false;  ///< one period is period_ exactly
  std::int64_t samples_ = 1;
  std::int64_t seconds_ = 1;
};

}  // namespace inslab::time
