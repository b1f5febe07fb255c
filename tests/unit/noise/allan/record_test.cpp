#include "inslab/noise/allan/record.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace record_test {

std::vector<double> numbers(std::size_t count) {
  return test::simulated_increments({1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.5, 5, count);
}

TEST(Record, KeepsSumsOfAsManyIncrementsAsItMust) {
  const std::vector<double> increments = numbers(64);
  Record record(0.5, 16);
  for (const double increment : increments) record.add(increment);
  ASSERT_EQ(record.samples_per_cluster(), 8);  // 16 sums of 4 were there, and went together
  const auto means = record.cluster_means();
  ASSERT_EQ(means.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    const auto first = increments.begin() + static_cast<std::ptrdiff_t>(8 * i);
    EXPECT_NEAR(means[i] + increments.front() / 0.5, std::accumulate(first, first + 8, 0.0) / (8 * 0.5), 1e-14);
  }
}

TEST(Record, DetailsAreDifferencesOfNeighboursThatDoNotOverlap) {
  const std::vector<double> increments = numbers(70);  // six of them complete no pair of clusters
  Record record(0.5, 16);
  for (const double increment : increments) record.add(increment);
  ASSERT_EQ(record.details().size(), 3u);
  for (std::size_t l = 0; l < 3; ++l) {
    const std::size_t m = std::size_t{1} << l;
    double squares = 0.0;
    for (std::size_t begin = 0; begin + 2 * m <= increments.size(); begin += 2 * m) {
      const auto first = increments.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto middle = first + static_cast<std::ptrdiff_t>(m);
      const double difference =
          std::accumulate(middle, middle + static_cast<std::ptrdiff_t>(m), 0.0) - std::accumulate(first, middle, 0.0);
      squares += difference * difference;
    }
    EXPECT_EQ(record.details()[l].count, static_cast<std::int64_t>(increments.size() / (2 * m)));
    EXPECT_NEAR(record.details()[l].squares, squares, 1e-12 * squares) << l;
  }
}

TEST(Record, KnowsItsMeanAndItsSpan) {
  const std::vector<double> increments = numbers(1000);
  Record record(0.5, 16);
  for (const double increment : increments) record.add(increment + 9.8);
  EXPECT_NEAR(record.mean(), (std::accumulate(increments.begin(), increments.end(), 0.0) / 1000.0 + 9.8) / 0.5, 1e-12);
  EXPECT_EQ(record.span_s(), 500.0);
}

TEST(Record, RefusesAnOddNumberOfClusters) {
  EXPECT_THROW(Record(1.0, 7), std::invalid_argument);
  EXPECT_THROW(Record(-1.0), std::invalid_argument);
}

}  // namespace record_test
}  // namespace inslab::allan
