#include "time/rate.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace inslab::time {

Rate::Rate(double hz) : period_(0) {
  if (!(hz > 0.0) || hz > 1e6) throw std::invalid_argument("a rate lies above 0 and at most at 1e6 Hz");
  const double period_ns = 1e9 / hz;
  const double nearest = std::round(period_ns);
  if (std::abs(period_ns - nearest) > 1e-6) {
    throw std::invalid_argument("the period of " + std::to_string(hz) + " Hz is not a whole number of nanoseconds");
  }
  period_ = Nanoseconds(static_cast<std::int64_t>(nearest));
}

std::uint32_t Rate::multiple_of(const Rate& faster) const {
  if (period_ % faster.period_ != Nanoseconds(0)) {
    throw std::invalid_argument("the period of " + std::to_string(period_.count()) +
                                " ns is not a multiple of the period of " + std::to_string(faster.period_.count()) +
                                " ns");
  }
  return static_cast<std::uint32_t>(period_ / faster.period_);
}

}  // namespace inslab::time
