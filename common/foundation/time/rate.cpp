#include "inslab/foundation/time/rate.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "inslab/foundation/time/whole_numbers.hpp"

namespace inslab::time {

namespace {

struct Fraction {
  std::int64_t numerator;
  std::int64_t denominator;
};

/// What the bits say: a whole number times a power of two.
Fraction bits_of(double x) {
  int exponent = 0;
  auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  exponent -= 53;
  while (mantissa % 2 == 0 && exponent < 0) {
    mantissa /= 2;
    ++exponent;
  }
  if (exponent >= 0) return {mantissa << exponent, 1};
  return {mantissa, std::int64_t{1} << -exponent};
}

/// The first convergent of the continued fraction of `x` that is `x` but for rounding. 1e-3 <= x <= 1e6.
Fraction simplest_fraction(double x) {
  constexpr double kRounding = 4e-16;
  std::int64_t before[] = {0, 1}, last[] = {1, 0};
  double rest = x;
  while (last[0] < (std::int64_t{1} << 40) && last[1] < (std::int64_t{1} << 40)) {
    const double whole = std::floor(rest);
    if (whole > 0x1p20) break;  // what is left of x is rounding
    for (int i = 0; i < 2; ++i) {
      const std::int64_t next = static_cast<std::int64_t>(whole) * last[i] + before[i];
      before[i] = last[i];
      last[i] = next;
    }
    const double value = static_cast<double>(last[0]) / static_cast<double>(last[1]);
    if (std::abs(value - x) <= kRounding * x) return {last[0], last[1]};
    rest = 1.0 / (rest - whole);
  }
  return bits_of(x);
}

}  // namespace

Rate::Rate(double hz) : hz_(hz) {
  if (!(hz >= 1e-3) || hz > 1e6) throw std::invalid_argument("a rate lies between 1e-3 and 1e6 Hz");
  const double period_ns = 1e9 / hz;
  const double nearest = std::round(period_ns);
  period_ = Nanoseconds(static_cast<std::int64_t>(nearest));
  is_whole_ = std::abs(period_ns - nearest) <= 1e-6;
  if (is_whole_) {
    const std::int64_t divisor = std::gcd(kNsPerSecond, period_.count());
    samples_ = kNsPerSecond / divisor;
    seconds_ = period_.count() / divisor;
    period_s_ = to_seconds(period_);
  } else {
    const Fraction rate = simplest_fraction(hz);
    samples_ = rate.numerator;
    seconds_ = rate.denominator;
    period_s_ = static_cast<double>(seconds_) / static_cast<double>(samples_);
  }
}

Nanoseconds Rate::at(std::uint64_t k) const {
  if (is_whole_) return period_ * static_cast<std::int64_t>(k);
  const Whole twice_ns = 2 * static_cast<Whole>(k) * kNsPerSecond * seconds_;
  return Nanoseconds(static_cast<std::int64_t>((twice_ns + samples_) / (2 * static_cast<Whole>(samples_))));
}

std::uint64_t Rate::index(Nanoseconds t) const {
  if (is_whole_) return static_cast<std::uint64_t>(t / period_);
  // at(k) <= t  <=>  k 1e9 seconds/samples + 1/2 < t + 1
  const Whole above = (2 * static_cast<Whole>(t.count()) + 1) * samples_;
  const Whole below = 2 * static_cast<Whole>(kNsPerSecond) * seconds_;
  return static_cast<std::uint64_t>((above + below - 1) / below - 1);
}

}  // namespace inslab::time
