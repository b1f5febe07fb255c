#include "inslab/noise/allan/allan_stream.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "inslab/noise/allan/confidence.hpp"
#include "tests/unit/noise/allan/simulated_noise.hpp"

namespace inslab::allan {
namespace allan_stream_test {

/// The definition: half the mean square of the difference of the mean rates of two neighbouring clusters, clusters
/// beginning at every `stride`-th sample. Quadratic in time, and shares no line with what it checks.
double from_the_definition(const std::vector<double>& increments, double dt_s, std::size_t m, std::size_t stride) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t begin = 0; begin + 2 * m <= increments.size(); begin += stride) {
    const auto first = increments.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto middle = first + static_cast<std::ptrdiff_t>(m);
    const double left = std::accumulate(first, middle, 0.0) / (static_cast<double>(m) * dt_s);
    const double right =
        std::accumulate(middle, middle + static_cast<std::ptrdiff_t>(m), 0.0) / (static_cast<double>(m) * dt_s);
    sum += 0.5 * (right - left) * (right - left);
    count += 1.0;
  }
  return sum / count;
}

NoiseModel white_and_bias() { return {0.3, 0.0, 0.0, 0.0, 0.5, 7.0}; }

std::vector<AllanPoint> streamed(const std::vector<double>& increments, double dt_s, std::vector<std::int64_t> sizes) {
  AllanStream stream(dt_s, std::move(sizes));
  for (const double increment : increments) stream.add(increment);
  return stream.points();
}

TEST(AllanStream, IsTheDefinitionAtAnySize) {
  const std::vector<double> increments = test::simulated_increments(white_and_bias(), 0.1, 3, 3001);
  const std::vector<std::int64_t> sizes{1, 2, 3, 7, 64, 96, 100, 101, 384, 1024, 1500};
  const auto points = streamed(increments, 0.1, sizes);
  ASSERT_EQ(points.size(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double expected = from_the_definition(increments, 0.1, static_cast<std::size_t>(sizes[i]),
                                                static_cast<std::size_t>(points[i].stride));
    EXPECT_EQ(points[i].m, sizes[i]);
    // The integral of 3001 numbers of size 0.2 carries rounding of 1e-13 into differences of size 0.1 and more.
    EXPECT_NEAR(points[i].variance, expected, 1e-11 * expected) << sizes[i];
  }
}

TEST(AllanStream, IsFullyOverlappedUpToSixtyThreeSamples) {
  const auto points = streamed(std::vector<double>(1000, 1.0), 1.0, {1, 31, 63, 64, 127});
  EXPECT_EQ(points[0].stride, 1);
  EXPECT_EQ(points[1].stride, 1);
  EXPECT_EQ(points[2].stride, 1);
  EXPECT_EQ(points[3].stride, 2);
  EXPECT_EQ(points[4].stride, 1);
  EXPECT_EQ(points[4].terms, 1000 + 1 - 2 * 127);
}

TEST(AllanStream, LeavesOutSizesWithoutASingleDifference) {
  const auto points = streamed(std::vector<double>(99, 1.0), 1.0, {10, 49, 50});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points.back().m, 49);
  EXPECT_EQ(points.back().terms, 2);
}

TEST(AllanStream, AConstantOfAnySizeIsNoNoise) {
  // Gravity at 200 Hz; what is left is the rounding of the increments themselves, at most 1e-17 m/s each way.
  const auto points = streamed(std::vector<double>(10000, 0.0490332), 0.005, {1, 100, 4096});
  for (const AllanPoint& point : points) EXPECT_EQ(point.variance, 0.0) << point.m;
}

TEST(AllanStream, MemoryDoesNotGrowWithTheRecord) {
  AllanStream stream(0.005, octave_cluster_sizes(16'200'000));
  const std::size_t before = stream.memory_bytes();
  for (int k = 0; k < 1'000'000; ++k) stream.add(k % 3);
  EXPECT_EQ(stream.memory_bytes(), before);
  EXPECT_LT(before, 30'000u);
}

TEST(AllanStream, ClustersEveryThirtySecondPartCostLessThanOnePercentOfTheDegreesOfFreedom) {
  const NoiseModel models[] = {
      {1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0, 0.0, 0.0}};
  for (const NoiseModel& model : models) {
    const AllanPoint every{256, 1.0, 1, 20000};
    const AllanPoint eighth{256, 1.0, 8, 2500};
    const double loss =
        1.0 - equivalent_degrees_of_freedom(eighth, model, 1.0) / equivalent_degrees_of_freedom(every, model, 1.0);
    EXPECT_LT(loss, 0.01);
  }
}

TEST(AllanStream, OctaveSizesRiseToTheLargestAndHaveLargeStrides) {
  const auto sizes = octave_cluster_sizes(1'000'000, 3);
  EXPECT_EQ(sizes.front(), 1);
  EXPECT_GT(sizes.back(), 700'000);
  for (std::size_t i = 1; i < sizes.size(); ++i) EXPECT_GT(sizes[i], sizes[i - 1]);
  const AllanStream stream(1.0, sizes);
  EXPECT_LT(stream.memory_bytes(), 25'000u);
}

TEST(AllanCurve, EndsAtAQuarterOfTheRecord) {
  EXPECT_EQ(curve_cluster_sizes(1001).back(), 250);
  EXPECT_EQ(curve_cluster_sizes(1024).back(), 256);
  EXPECT_EQ(curve_cluster_sizes(4).back(), 1);
  EXPECT_TRUE(curve_cluster_sizes(3).empty());
}

TEST(AllanStream, RefusesSizesAndIntervalsThatAreNone) {
  EXPECT_THROW(AllanStream(1.0, {0}), std::invalid_argument);
  EXPECT_THROW(AllanStream(0.0, {1}), std::invalid_argument);
}

}  // namespace allan_stream_test
}  // namespace inslab::allan
