#pragma once

#include "inslab/noise/random/philox.hpp"

/// Uniform and normal numbers from random bits.
///
/// Logarithm, sine and cosine are written out instead of taken from the C library, which picks its code by the CPU's
/// features so that the last bit follows the machine: sums, products, one division and a square root round alike on
/// every IEEE machine. Two lanes at a time they are faster, too.
namespace inslab::random {

/// The upper 52 bits of each lane over 2^52: [0, 1), exact.
inline Doubles uniform_from_bits(Words bits) {
  constexpr std::uint64_t kBitsOf1 = 0x3FF0000000000000;
  return doubles_of((bits >> 12) | kBitsOf1) - 1.0;
}

/// Natural logarithm of u in [2^-52, 1]; relative error below 4e-16.
inline Doubles log_of_unit(Doubles u) {
  // u = 2^e m with m in [sqrt(1/2), sqrt(2)): adding the distance of 1 from sqrt(1/2) to the bits carries into e.
  constexpr std::uint64_t kBitsOf1 = 0x3FF0000000000000;
  constexpr std::uint64_t kBitsOfSqrtHalf = 0x3FE6A09E667F3BCD;
  constexpr std::uint64_t kMantissa = 0x000FFFFFFFFFFFFF;
  const Words bits = bits_of(u) + (kBitsOf1 - kBitsOfSqrtHalf);
  const Doubles e = doubles_from_integers(bits >> 52) - 1023.0;
  const Doubles m = doubles_of((bits & kMantissa) + kBitsOfSqrtHalf);
  // log m = 2 artanh s, s = (m-1)/(m+1), |s| <= 0.1716: the first term left out is s^20/21 < 3e-17 of the sum.
  const Doubles s = (m - 1.0) / (m + 1.0);
  const Doubles z = s * s;
  const Doubles z2 = z * z;
  const Doubles z4 = z2 * z2;
  const Doubles series = (1.0 / 3 + z * (1.0 / 5)) + z2 * (1.0 / 7 + z * (1.0 / 9)) +
                         z4 * ((1.0 / 11 + z * (1.0 / 13)) + z2 * (1.0 / 15 + z * (1.0 / 17)) + z4 * (1.0 / 19));
  constexpr double kLn2 = 0.69314718055994530942;
  return e * kLn2 + (2.0 * s + 2.0 * s * z * series);
}

struct CosSin {
  Doubles cosine;
  Doubles sine;
};

/// Cosine and sine of 2 pi times the upper 52 bits over 2^52; absolute error below 3e-16.
inline CosSin cos_sin_from_bits(Words bits) {
  // The nearest quarter turn is taken off exactly; |x| <= pi/4 remains. Terms left out: x^17/17! < 5e-17.
  const Words quarter = ((bits >> 61) + 1) >> 1;
  const Doubles x = 6.28318530717958647693 * (uniform_from_bits(bits) - 0.25 * doubles_from_integers(quarter));
  const Doubles z = x * x;
  const Doubles z2 = z * z;
  const Doubles z4 = z2 * z2;
  const Doubles sine_series = (-1.0 / 6 + z * (1.0 / 120)) + z2 * (-1.0 / 5040 + z * (1.0 / 362880)) +
                              z4 * ((-1.0 / 39916800 + z * (1.0 / 6227020800.0)) + z2 * (-1.0 / 1307674368000.0));
  const Doubles cosine_series =
      (-1.0 / 2 + z * (1.0 / 24)) + z2 * (-1.0 / 720 + z * (1.0 / 40320)) +
      z4 * ((-1.0 / 3628800 + z * (1.0 / 479001600)) + z2 * (-1.0 / 87178291200.0 + z * (1.0 / 20922789888000.0)));
  const Words cosine = bits_of(1.0 + z * cosine_series);
  const Words sine = bits_of(x + x * z * sine_series);
  // cos and sin of x + quarter * pi/2: an odd quarter swaps them, and the sign bit is set where the quadrant says so.
  const Words swapped = (cosine ^ sine) & (both(0) - (quarter & 1));
  return {doubles_of((cosine ^ swapped) ^ (((quarter + 1) & 2) << 62)),
          doubles_of((sine ^ swapped) ^ ((quarter & 2) << 62))};
}

/// Two pairs of independent standard normal numbers, `cosine` and `sine` of each lane (Box and Muller, 1958);
/// |value| <= sqrt(2 * 52 * ln 2) = 8.5.
inline CosSin normals_from_bits(const RandomBits& bits) {
  const Doubles u = uniform_from_bits(bits.first) + 0x1p-52;  // (0, 1]: its logarithm is finite
  const Doubles radius = square_root(-2.0 * log_of_unit(u));
  const CosSin direction = cos_sin_from_bits(bits.second);
  return {radius * direction.cosine, radius * direction.sine};
}

}  // namespace inslab::random
