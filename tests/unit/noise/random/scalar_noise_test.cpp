#include "inslab/noise/random/scalar_noise.hpp"

#include <gtest/gtest.h>

namespace inslab::random {
namespace {

TEST(ScalarNoise, IsWhiteNoiseAndAGaussMarkovProcessOfStreamsOfTheirOwn) {
  const Stream root(3, "barometer0/pressure");
  ScalarNoise noise(root, 0.1);
  noise.retune(2.0, 5.0, 60.0);
  GaussMarkov drift({5.0, 60.0}, 0.1, Stream(3, "barometer0/pressure/gm"));
  const Stream white(3, "barometer0/pressure/white");
  for (std::uint64_t k = 1; k < 30; ++k) EXPECT_EQ(noise.advance(k), 2.0 * white.normal(k) + drift.advance(k - 1));
}

TEST(ScalarNoise, AResetTakesTheDriftToZeroAndARedrawElsewhere) {
  ScalarNoise noise(Stream(3, "x"), 0.1);
  noise.retune(0.0, 5.0, 1e9);  // so long that the state stays
  noise.advance(1);
  noise.reset();
  EXPECT_NEAR(noise.advance(2), 0.0, 5.0 * 6.0 * 1.5e-5);  // a step's sigma is 5 sqrt(2 dt/T)
  noise.redraw(2);
  EXPECT_NEAR(noise.advance(3), 5.0 * Stream(3, "x/gm/redraw").normal(2), 5.0 * 6.0 * 1.5e-5);
}

}  // namespace
}  // namespace inslab::random
