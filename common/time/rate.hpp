#pragma once

#include "time/gps_time.hpp"

namespace inslab::time {

/// The grid t_k = k * period of a stream; never accumulated, so it cannot drift.
class Rate {
 public:
  /// Throws std::invalid_argument unless 1e9 / hz is a whole number of nanoseconds within 1e-6 (1, 5, 200, 1000, ...
  /// Hz; not 3 Hz) and 0 < hz <= 1e6.
  explicit Rate(double hz);

  Nanoseconds period() const { return period_; }
  double period_s() const { return to_seconds(period_); }
  Nanoseconds at(std::uint64_t k) const { return period_ * static_cast<std::int64_t>(k); }

  /// How many periods of `faster` make one of this. Throws std::invalid_argument when it is not a whole number.
  std::uint32_t multiple_of(const Rate& faster) const;

 private:
  Nanoseconds period_;
};

}  // namespace inslab::time
