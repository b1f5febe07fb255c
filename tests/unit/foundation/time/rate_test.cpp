#include "inslab/foundation/time/rate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace inslab::time {
namespace rate_test {

/// Rates of real sensors, of whole periods and of others.
const std::vector<double> kRates{0.1,    0.3,    1.0,    3.0,     7.0,    29.97,       33.333333333333336,
                                 50.0,   59.94,  60.0,   99.9981, 100.0,  102.4,       119.88,
                                 120.0,  125.0,  128.0,  150.0,   199.87, 200.0,       250.0,
                                 300.0,  400.0,  416.0,  600.0,   833.0,  1000.0 / 3., 952.0,
                                 1000.0, 1024.0, 1666.0, 2000.0,  3000.0, 4096.0,      6667.0,
                                 10000.0};

TEST(Rate, IsTheSimplestFractionThatTheNumberStandsFor) {
  const auto fraction = [](double hz) { return std::make_pair(Rate(hz).samples(), Rate(hz).seconds()); };
  EXPECT_EQ(fraction(200.0), std::make_pair(std::int64_t{200}, std::int64_t{1}));
  EXPECT_EQ(fraction(300.0), std::make_pair(std::int64_t{300}, std::int64_t{1}));
  EXPECT_EQ(fraction(std::nextafter(300.0, 301.0)), std::make_pair(std::int64_t{300}, std::int64_t{1}));
  EXPECT_EQ(fraction(29.97), std::make_pair(std::int64_t{2997}, std::int64_t{100}));
  EXPECT_EQ(fraction(100.0 / 3.0), std::make_pair(std::int64_t{100}, std::int64_t{3}));
  EXPECT_EQ(fraction(0.3), std::make_pair(std::int64_t{3}, std::int64_t{10}));
  EXPECT_EQ(fraction(99.9981), std::make_pair(std::int64_t{999981}, std::int64_t{10000}));
}

TEST(Rate, InstantsAreTheNearestWholeNanoseconds) {
  const Rate rate(300.0);
  EXPECT_EQ(rate.at(1).count(), 3'333'333);
  EXPECT_EQ(rate.at(2).count(), 6'666'667);
  EXPECT_EQ(rate.at(3).count(), 10'000'000);
  EXPECT_EQ(Rate(1024.0).at(1).count(), 976'563);    // 976562.5: halves go up
  EXPECT_EQ(Rate(1024.0).at(3).count(), 2'929'688);  // 2929687.5
  EXPECT_EQ(Rate(200.0).at(3).count(), 15'000'000);
}

TEST(Rate, DoesNotDriftInADayNorInAYear) {
  for (const double hz : kRates) {
    const Rate rate(hz);
    // A time that holds whole numbers of both seconds() and samples().
    const std::int64_t turns = 86'400 / rate.seconds() + 1;
    const auto k = static_cast<std::uint64_t>(turns * rate.samples());
    EXPECT_EQ(rate.at(k), std::chrono::seconds(turns * rate.seconds())) << hz;
    EXPECT_EQ(rate.at(365 * k), std::chrono::seconds(365 * turns * rate.seconds())) << hz;
  }
  EXPECT_EQ(Rate(200.0).at(200ull * 86'400), std::chrono::hours(24));
  EXPECT_EQ(Rate(1024.0).at(1024ull * 86'400), std::chrono::hours(24));
  EXPECT_EQ(Rate(300.0).at(300ull * 86'400), std::chrono::hours(24));
}

TEST(Rate, IntervalsDifferByOneNanosecondAtMostAndSumToTheTime) {
  for (const double hz : kRates) {
    const Rate rate(hz);
    Nanoseconds sum{0}, shortest = Nanoseconds::max(), longest{0};
    for (std::uint64_t k = 1; k <= 5000; ++k) {
      const Nanoseconds interval = rate.at(k) - rate.at(k - 1);
      sum += interval;
      shortest = std::min(shortest, interval);
      longest = std::max(longest, interval);
      // The nearest: within half a nanosecond of k/rate, as long double tells it.
      const long double exact = 1e9L * static_cast<long double>(k) * static_cast<long double>(rate.seconds()) /
                                static_cast<long double>(rate.samples());
      ASSERT_LE(std::abs(exact - static_cast<long double>(rate.at(k).count())), 0.5L + 1e-6L) << hz << ' ' << k;
    }
    EXPECT_EQ(sum, rate.at(5000)) << hz;
    EXPECT_LE(longest - shortest, Nanoseconds(1)) << hz;
  }
}

TEST(Rate, IndexFindsEveryInstantAndWhatLiesBetween) {
  std::mt19937_64 random(1);
  for (const double hz : kRates) {
    const Rate rate(hz);
    for (int i = 0; i < 2000; ++i) {
      const std::uint64_t k = random() % static_cast<std::uint64_t>(hz * 1e7 + 1.0);
      const Nanoseconds t = rate.at(k);
      ASSERT_EQ(rate.index(t), k) << hz;
      ASSERT_TRUE(rate.contains(t)) << hz;
      if (k == 0) continue;
      ASSERT_EQ(rate.index(t - Nanoseconds(1)), k - 1) << hz;
      ASSERT_FALSE(rate.contains(t - Nanoseconds(1))) << hz;
    }
  }
}

TEST(Rate, WholePeriodsAreMultiplesOfThePeriod) {
  for (const double hz : {0.1, 1.0, 5.0, 12.5, 200.0, 1000.0, 4096.0 / 8.0, 100.0 / 3.0}) {
    const Rate rate(hz);
    for (const std::uint64_t k : {1ull, 2ull, 17ull, 123'456'789ull}) {
      EXPECT_EQ(rate.at(k), rate.period() * static_cast<std::int64_t>(k)) << hz;
    }
    EXPECT_EQ(rate.period_s(), to_seconds(rate.period())) << hz;
  }
}

TEST(Rate, RefusesWhatIsNoRate) {
  EXPECT_THROW(Rate(0.0), std::invalid_argument);
  EXPECT_THROW(Rate(-1.0), std::invalid_argument);
  EXPECT_THROW(Rate(0.0 / 0.0), std::invalid_argument);
  EXPECT_THROW(Rate(1e-4), std::invalid_argument);
  EXPECT_THROW(Rate(2e6), std::invalid_argument);
}

}  // namespace rate_test
}  // namespace inslab::time
