#include "inslab/noise/random/philox.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

namespace inslab::random {
namespace philox_test {

std::array<std::uint32_t, 4> outputs(const RandomBits& bits, int lane) {
  return {static_cast<std::uint32_t>(bits.first[lane]), static_cast<std::uint32_t>(bits.first[lane] >> 32),
          static_cast<std::uint32_t>(bits.second[lane]), static_cast<std::uint32_t>(bits.second[lane] >> 32)};
}

using Outputs = std::array<std::uint32_t, 4>;

// The three vectors of Random123's tests/kat_vectors, lines "philox4x32 10": counter, key, expected output.
TEST(Philox, MeetsThePublishedKnownAnswers) {
  EXPECT_EQ(outputs(philox<1>(0, 0, 0)[0], 0), (Outputs{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(outputs(philox<1>(~0ULL, ~0ULL, ~0ULL)[0], 0), (Outputs{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(outputs(philox<1>(0x299f31d0a4093822, 0x85a308d3243f6a88, 0x0370734413198a2e)[0], 0),
            (Outputs{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, AgreesWithRandom123InEveryLane) {
  std::uint64_t word = 0x9E3779B97F4A7C15;
  const auto next = [&word] { return word = word * 6364136223846793005 + 1442695040888963407; };
  for (int trial = 0; trial < 1000; ++trial) {
    const std::uint64_t key = next(), block = next(), name = next();
    const auto bits = philox<2>(key, block, name);
    for (std::uint64_t i = 0; i < 4; ++i) {
      const std::uint64_t low = block + i;
      const philox4x32_ctr_t counter{{static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32),
                                      static_cast<std::uint32_t>(name), static_cast<std::uint32_t>(name >> 32)}};
      const philox4x32_key_t seed{{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
      const philox4x32_ctr_t expected = philox4x32(counter, seed);
      EXPECT_EQ(outputs(bits[i / 2], static_cast<int>(i % 2)),
                (Outputs{expected.v[0], expected.v[1], expected.v[2], expected.v[3]}));
    }
  }
}

}  // namespace philox_test
}  // namespace inslab::random
