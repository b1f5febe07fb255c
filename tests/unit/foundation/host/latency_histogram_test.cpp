#include "inslab/foundation/host/latency_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace inslab::host {
namespace latency_histogram_test {

TEST(LatencyHistogram, HasNothingToSayOfNothing) {
  const LatencyHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.max_s(), -1.0);
  EXPECT_EQ(histogram.quantile_s(0.5), -1.0);
}

TEST(LatencyHistogram, QuantilesAreTheExactOnesToOnePercent) {
  // A bin is 2 % wide and answers with its middle: at most sqrt(1.02) - 1 < 1 % from any value in it.
  std::mt19937_64 engine(6);
  std::lognormal_distribution<double> latency(std::log(2e-4), 1.5);
  LatencyHistogram histogram;
  std::vector<double> all;
  for (int i = 0; i < 20000; ++i) {
    all.push_back(latency(engine));
    histogram.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double q : {0.0, 1e-4, 0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(q * 20000.0)));
    EXPECT_NEAR(histogram.quantile_s(q), all[rank - 1], 0.01 * all[rank - 1]) << "q " << q;
  }
  EXPECT_EQ(histogram.max_s(), all.back());
  EXPECT_LE(histogram.quantile_s(1.0), histogram.max_s());
}

TEST(LatencyHistogram, CountsWhatLiesOutsideInTheBinAtThatEnd) {
  LatencyHistogram histogram;
  histogram.add(-3.0);
  histogram.add(0.0);
  histogram.add(1e9);
  EXPECT_EQ(histogram.count(), 3U);
  EXPECT_NEAR(histogram.quantile_s(0.5), 1e-7, 1e-9);
  EXPECT_NEAR(histogram.quantile_s(1.0), 1e3, 30.0);
  EXPECT_EQ(histogram.max_s(), 1e9);
}

}  // namespace latency_histogram_test
}  // namespace inslab::host
