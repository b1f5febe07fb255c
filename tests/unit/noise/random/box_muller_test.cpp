#include "inslab/noise/random/box_muller.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace inslab::random {
namespace box_muller_test {

constexpr long double kTwoPi = 6.28318530717958647692528676655900577L;

/// Words that differ in all their bits.
std::uint64_t word(std::uint64_t i) { return i * 0x9E3779B97F4A7C15 + (i << 40); }

TEST(BoxMuller, UniformNumbersAreTheUpperBitsExactly) {
  EXPECT_EQ(uniform_from_bits(Words{0, 0xFFF})[0], 0.0);
  EXPECT_EQ(uniform_from_bits(Words{0, 0xFFF})[1], 0.0);
  EXPECT_EQ(uniform_from_bits(Words{0x1000, ~0ULL})[0], 0x1p-52);
  EXPECT_EQ(uniform_from_bits(Words{0x1000, ~0ULL})[1], 1.0 - 0x1p-52);
}

TEST(BoxMuller, LogarithmIsGoodToTwoRoundings) {
  // 4e-16 is 1.8 units of rounding; the long double logarithm has 64 bits and counts as exact.
  for (std::uint64_t i = 1; i < 200000; ++i) {
    double u = static_cast<double>(word(i) >> 12) * 0x1p-52;
    if (i % 3 == 0) u = std::max(0x1p-52, std::ldexp(u, -static_cast<int>(i % 50)));
    if (i % 3 == 1) u = 1.0 - u * std::ldexp(1.0, -static_cast<int>(i % 40));
    u = std::max(u, 0x1p-52);
    const long double expected = std::log(static_cast<long double>(u));
    EXPECT_NEAR(log_of_unit(Doubles{u, 1.0})[0], static_cast<double>(expected),
                4e-16 * std::abs(static_cast<double>(expected)))
        << u;
  }
  EXPECT_EQ(log_of_unit(Doubles{1.0, 0x1p-52})[0], 0.0);
}

TEST(BoxMuller, CosineAndSineAreGoodToTheirRounding) {
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const std::uint64_t bits = i < 64 ? i << 58 : word(i);  // all multiples of 1/64 turn, where the quadrants meet
    const long double angle = kTwoPi * static_cast<long double>(bits >> 12) * 0x1p-52L;
    const auto [cosine, sine] = cos_sin_from_bits(Words{bits, 0});
    EXPECT_NEAR(cosine[0], static_cast<double>(std::cos(angle)), 3e-16);
    EXPECT_NEAR(sine[0], static_cast<double>(std::sin(angle)), 3e-16);
  }
}

TEST(BoxMuller, TheLargestNormalNumberIsFinite) {
  const auto [cosine, sine] = normals_from_bits({both(0), both(0)});
  EXPECT_NEAR(cosine[0], std::sqrt(2.0 * 52.0 * std::log(2.0)), 1e-14);
  EXPECT_EQ(sine[0], 0.0);
}

}  // namespace box_muller_test
}  // namespace inslab::random
