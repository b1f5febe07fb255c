#include "inslab/noise/random/stream.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace inslab::random {
namespace stream_test {

constexpr std::uint64_t kSeed = 20240229;

std::vector<double> normals(const Stream& stream, std::size_t count) {
  NormalCursor cursor(stream);
  std::vector<double> values(count);
  for (std::size_t k = 0; k < count; ++k) values[k] = cursor.at(k);
  return values;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y, std::size_t lag = 0) {
  double sum = 0.0;
  const std::size_t count = x.size() - lag;
  for (std::size_t k = 0; k < count; ++k) sum += x[k] * y[k + lag];
  return sum / static_cast<double>(count);
}

TEST(Stream, ADrawDependsOnSeedNameAndIndexAlone) {
  const Stream a(kSeed, "imu0/gyro.x/arw");
  const Stream b(kSeed, "imu0/gyro.x/arw");
  for (std::uint64_t k = 100; k-- > 0;) EXPECT_EQ(a.normal(k), b.normal(k));
  EXPECT_NE(a.normal(7), Stream(kSeed + 1, "imu0/gyro.x/arw").normal(7));
  EXPECT_NE(a.normal(7), Stream(kSeed, "imu0/gyro.y/arw").normal(7));
  EXPECT_NE(a.normal(7), a.normal(8));
}

// The bits are a promise across builds and machines: these were taken once, and a change of them breaks every log.
TEST(Stream, ItsNumbersDoNotChangeFromVersionToVersion) {
  const Stream stream(1, "imu0/gyro.x/arw");
  EXPECT_EQ(stream.normal(0), -0x1.2cdd74f69013p-2);
  EXPECT_EQ(stream.normal(1), -0x1.66307d5cf6ea4p-4);
  EXPECT_EQ(stream.normal(1000000007), 0x1.6038b98cb98d6p-4);
  EXPECT_EQ(stream.uniform(3), 0x1.218557ac92674p-2);
}

TEST(Stream, ACursorGivesTheSameNumbersInAnyOrder) {
  const Stream stream(kSeed, "imu1/accel.z/vrw");
  NormalCursor cursor(stream);
  for (std::uint64_t k = 0; k < 50; ++k) EXPECT_EQ(cursor.at(k), stream.normal(k));
  for (const std::uint64_t k : {17ULL, 16ULL, 3ULL, 1ULL << 40, 0ULL}) EXPECT_EQ(cursor.at(k), stream.normal(k));
}

TEST(Stream, AChildIsTheStreamOfTheJoinedName) {
  EXPECT_EQ(Stream(kSeed, "imu0/gyro.x").child("/arw"), Stream(kSeed, "imu0/gyro.x/arw"));
  EXPECT_NE(Stream(kSeed, "imu0/gyro.x").child("/arw"), Stream(kSeed, "imu0/gyro.x"));
}

TEST(Stream, NormalNumbersHaveTheMomentsOfTheNormalDistribution) {
  // Standard errors of N draws: mean 1/sqrt(N), variance sqrt(2/N), third moment sqrt(15/N), fourth sqrt(96/N).
  constexpr std::size_t kCount = 1000000;
  const double root = std::sqrt(static_cast<double>(kCount));
  double m1 = 0.0, m2 = 0.0, m3 = 0.0, m4 = 0.0;
  for (const double x : normals(Stream(kSeed, "moments"), kCount)) {
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
  }
  EXPECT_NEAR(m1 / kCount, 0.0, 4.0 / root);
  EXPECT_NEAR(m2 / kCount, 1.0, 4.0 * std::sqrt(2.0) / root);
  EXPECT_NEAR(m3 / kCount, 0.0, 4.0 * std::sqrt(15.0) / root);
  EXPECT_NEAR(m4 / kCount, 3.0, 4.0 * std::sqrt(96.0) / root);
}

TEST(Stream, NormalNumbersFillTheTailsAsTheDistributionSays) {
  // Counts beyond z are binomial: standard error sqrt(N p (1 - p)).
  constexpr std::size_t kCount = 1000000;
  const std::vector<double> values = normals(Stream(kSeed, "tails"), kCount);
  for (const double z : {0.5, 1.0, 2.0, 3.0, 4.0}) {
    const double p = std::erfc(z / std::sqrt(2.0));
    double beyond = 0.0;
    for (const double x : values) beyond += std::abs(x) > z ? 1.0 : 0.0;
    EXPECT_NEAR(beyond, kCount * p, 4.0 * std::sqrt(kCount * p * (1.0 - p))) << z;
  }
}

TEST(Stream, UniformNumbersFillTheUnitIntervalEvenly) {
  // Pearson's chi-square over 100 bins has mean 99 and standard deviation sqrt(2 * 99) = 14.1.
  constexpr int kCount = 100000;
  const Stream stream(kSeed, "uniform");
  std::vector<double> bins(100, 0.0);
  for (std::uint64_t k = 0; k < kCount; ++k) {
    const double u = stream.uniform(k);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    bins[static_cast<std::size_t>(u * 100.0)] += 1.0;
  }
  double chi_square = 0.0;
  for (const double count : bins) chi_square += (count - 1000.0) * (count - 1000.0) / 1000.0;
  EXPECT_NEAR(chi_square, 99.0, 4.0 * std::sqrt(2.0 * 99.0));
}

TEST(Stream, EveryPairOfStreamsIsUncorrelated) {
  // The correlation of two independent streams has standard error 1/sqrt(N); the largest of 300 pairs stays within 4.5
  // of them with probability 1 - 300 * 7e-6 = 0.998.
  constexpr std::size_t kCount = 20000;
  std::vector<std::vector<double>> streams;
  for (const char* sensor : {"imu0", "imu1"}) {
    for (const char* axis : {"gyro.x", "gyro.y", "gyro.z", "accel.x", "accel.y", "accel.z"}) {
      for (const char* term : {"arw", "bias_gm"}) {
        streams.push_back(normals(Stream(kSeed, std::string(sensor) + "/" + axis + "/" + term), kCount));
      }
    }
  }
  streams.push_back(normals(Stream(kSeed + 1, "imu0/gyro.x/arw"), kCount));
  ASSERT_EQ(streams.size(), 25U);
  const double bound = 4.5 / std::sqrt(static_cast<double>(kCount));
  for (std::size_t i = 0; i < streams.size(); ++i) {
    for (std::size_t j = i + 1; j < streams.size(); ++j) {
      EXPECT_LT(std::abs(correlation(streams[i], streams[j])), bound) << i << " and " << j;
    }
  }
}

TEST(Stream, AStreamIsUncorrelatedWithItsOwnPast) {
  // 32 lags, which cover the pairs and groups that are drawn together; bound as above.
  constexpr std::size_t kCount = 200000;
  const std::vector<double> values = normals(Stream(kSeed, "imu0/gyro.x/arw"), kCount);
  for (std::size_t lag = 1; lag <= 32; ++lag) {
    EXPECT_LT(std::abs(correlation(values, values, lag)), 4.5 / std::sqrt(static_cast<double>(kCount - lag))) << lag;
  }
}

TEST(Stream, NoTwoNamesOfALargeInstallationShareNumbers) {
  std::set<double> first_draws;
  std::size_t names = 0;
  for (int number = 0; number < 16; ++number) {
    for (const char* axis : {"gyro.x", "gyro.y", "gyro.z", "accel.x", "accel.y", "accel.z"}) {
      for (const char* term : {"arw", "vrw", "bias_gm", "bias_turn_on", "bias_gm/redraw"}) {
        const std::string name = "imu" + std::to_string(number) + "/" + axis + "/" + term;
        first_draws.insert(Stream(kSeed, name).normal(0));
        ++names;
      }
    }
  }
  EXPECT_EQ(first_draws.size(), names);
}

}  // namespace stream_test
}  // namespace inslab::random
