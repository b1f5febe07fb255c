#pragma once

#include <array>

#include "inslab/noise/random/lanes.hpp"

namespace inslab::random {

/// Two times 128 random bits: lane i of `first` holds the generator's 32-bit outputs 0 (low half) and 1 of counter i,
/// lane i of `second` its outputs 2 and 3.
struct RandomBits {
  Words first;
  Words second;
};

/// Philox4x32-10 of 2 * N successive counters: a pure function of the key and of the counter (block + i, name), each
/// given as two 64-bit words of which the low half comes first.
/// Source: Salmon, Moraes, Dror, Shaw, "Parallel random numbers: as easy as 1, 2, 3", SC11, section 3.3 and table 2.
template <int N>
__attribute__((always_inline)) inline std::array<RandomBits, N> philox(std::uint64_t key, std::uint64_t block,
                                                                       std::uint64_t name) {
  constexpr std::uint64_t kLow = 0xFFFFFFFF;
  Words c0[N], c1[N], c2[N], c3[N];
  for (int i = 0; i < N; ++i) {
    const Words counter{block + 2 * i, block + 2 * i + 1};
    c0[i] = counter & kLow;
    c1[i] = counter >> 32;
    c2[i] = both(name & kLow);
    c3[i] = both(name >> 32);
  }
  std::uint64_t key_low = key & kLow;
  std::uint64_t key_high = key >> 32;
#pragma GCC unroll 10
  for (int round = 0; round < 10; ++round) {
#pragma GCC unroll 8
    for (int i = 0; i < N; ++i) {
      const Words p0 = product_of_low_halves(c0[i], both(0xD2511F53));
      const Words p1 = product_of_low_halves(c2[i], both(0xCD9E8D57));
      c0[i] = (p1 >> 32) ^ c1[i] ^ both(key_low);
      c1[i] = p1 & kLow;
      c2[i] = (p0 >> 32) ^ c3[i] ^ both(key_high);
      c3[i] = p0 & kLow;
    }
    key_low = (key_low + 0x9E3779B9) & kLow;
    key_high = (key_high + 0xBB67AE85) & kLow;
  }
  std::array<RandomBits, N> out;
  for (int i = 0; i < N; ++i) out[i] = {c0[i] | (c1[i] << 32), c2[i] | (c3[i] << 32)};
  return out;
}

}  // namespace inslab::random
