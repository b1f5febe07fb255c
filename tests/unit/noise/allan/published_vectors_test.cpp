#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "inslab/noise/allan/allan_stream.hpp"
#include "inslab/noise/allan/confidence.hpp"
#include "tests/unit/noise/allan/simulated_noise.hpp"

/// Overlapped Allan deviations that others have published: the two sets of NBS Monograph 140 as given in W. Riley,
/// "Handbook of Frequency Stability Analysis", NIST SP 1065, section 12.4, and what Stable32 1.60 says of the second
/// (its file PHASE.DAT).
namespace inslab::allan {
namespace published_vectors_test {

/// n[0] = 1234567890, n[i+1] = 16807 n[i] mod 2^31 - 1; frequencies n[i]/(2^31 - 1) at 1 Hz (SP 1065, 12.4).
std::vector<double> nbs_frequencies() {
  std::vector<double> frequencies;
  std::uint64_t n = 1234567890;
  for (int i = 0; i < 1000; ++i) {
    frequencies.push_back(static_cast<double>(n) / 2147483647.0);
    n = 16807 * n % 2147483647;
  }
  return frequencies;
}

double deviation(const std::vector<double>& increments, std::int64_t m) {
  return std::sqrt(overlapped_allan_variance(test::integrated(increments), 1.0, m).variance);
}

TEST(PublishedAllanVectors, NineFrequenciesOfMonograph140) {
  const std::vector<double> frequencies{892, 809, 823, 798, 671, 644, 883, 903, 677};
  EXPECT_NEAR(deviation(frequencies, 1), 91.22945, 5e-6);
  EXPECT_NEAR(deviation(frequencies, 2), 85.95287, 5e-6);
}

TEST(PublishedAllanVectors, ThousandFrequenciesOfMonograph140) {
  const std::vector<double> frequencies = nbs_frequencies();
  EXPECT_NEAR(deviation(frequencies, 1), 2.922319e-01, 5e-8);
  EXPECT_NEAR(deviation(frequencies, 10), 9.159953e-02, 5e-9);
  EXPECT_NEAR(deviation(frequencies, 100), 3.241343e-02, 5e-9);
}

struct Stable32Row {
  std::int64_t m;
  std::int64_t terms;
  double low, sigma, high;  ///< five digits
};

// "Overlapping Allan", white noise of frequency, confidence factor 0.683.
const std::vector<Stable32Row> kStable32{
    {1, 999, 2.8515e-01, 2.9223e-01, 2.9987e-01},  {2, 997, 1.9520e-01, 2.0102e-01, 2.0738e-01},
    {4, 993, 1.3931e-01, 1.4479e-01, 1.5098e-01},  {8, 985, 1.0038e-01, 1.0570e-01, 1.1198e-01},
    {16, 969, 5.7696e-02, 6.1915e-02, 6.7217e-02}, {32, 937, 4.3654e-02, 4.8082e-02, 5.4202e-02},
    {64, 873, 3.1755e-02, 3.6237e-02, 4.3377e-02}, {128, 745, 2.3045e-02, 2.7674e-02, 3.7027e-02}};

TEST(PublishedAllanVectors, OctavesOfStable32) {
  const std::vector<double> phase = test::integrated(nbs_frequencies());
  for (const Stable32Row& row : kStable32) {
    const AllanPoint point = overlapped_allan_variance(phase, 1.0, row.m);
    EXPECT_EQ(point.terms, row.terms) << row.m;
    EXPECT_NEAR(std::sqrt(point.variance), row.sigma, 1e-4 * row.sigma) << row.m;
  }
}

// Stable32 takes its degrees of freedom from fits to simulations, ours are exact.
TEST(PublishedAllanVectors, ConfidenceLimitsOfStable32) {
  const std::vector<double> phase = test::integrated(nbs_frequencies());
  NoiseModel white;
  white.white = 1.0;
  for (const Stable32Row& row : kStable32) {
    const AllanPoint point = overlapped_allan_variance(phase, 1.0, row.m);
    const Interval interval =
        variance_interval(point.variance, equivalent_degrees_of_freedom(point, white, 1.0), 0.683);
    EXPECT_NEAR(std::sqrt(interval.low), row.low, 0.01 * row.low) << row.m;
    EXPECT_NEAR(std::sqrt(interval.high), row.high, 0.01 * row.high) << row.m;
  }
}

TEST(PublishedAllanVectors, EveryFactorOfStable32sFileWhereItIsThere) {
  const std::string folder = INSLAB_SOURCE_DIR "/../shared/data/allan/allantools_phasedat/";
  std::ifstream data(folder + "PHASE.DAT"), table(folder + "phase_dat_oadev.txt");
  if (!data || !table) GTEST_SKIP() << "PHASE.DAT of Stable32 is not beside the sources";
  std::vector<double> phase;
  for (std::string line; std::getline(data, line);) {
    if (line.rfind('#', 0) != 0) phase.push_back(std::stod(line));
  }
  ASSERT_EQ(phase.size(), 1001u);
  int rows = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.rfind('#', 0) == 0) continue;
    std::istringstream columns(line);
    std::int64_t m = 0, terms = 0;
    double tau = 0.0, alpha = 0.0, low = 0.0, sigma = 0.0;
    if (!(columns >> m >> tau >> terms >> alpha >> low >> sigma)) continue;
    const AllanPoint point = overlapped_allan_variance(phase, 1.0, m);
    EXPECT_EQ(point.terms, terms) << m;
    EXPECT_NEAR(std::sqrt(point.variance), sigma, 1e-4 * sigma) << m;
    ++rows;
  }
  EXPECT_GT(rows, 100);
}

}  // namespace published_vectors_test
}  // namespace inslab::allan
