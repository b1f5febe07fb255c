#include "inslab/foundation/time/grid.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

namespace inslab::time {
namespace grid_test {

Grid grid_of(const std::vector<double>& rates_hz) {
  std::vector<Rate> rates;
  for (const double hz : rates_hz) rates.emplace_back(hz);
  return Grid(rates);
}

/// Sets of a truth's and its sensors' rates.
const std::vector<std::vector<double>> kSets{
    {200.0},
    {200.0, 200.0, 5.0, 1.0},
    {1000.0, 300.0},
    {200.0, 1024.0, 10.0},
    {120.0, 120.0, 4.0, 1.0},
    {200.0, 60.0, 150.0, 8.0},
    {1000.0, 600.0, 1024.0, 7.0},
    {3000.0, 1024.0, 10.0},
    {29.97, 30.0, 1.0},
    {99.9981, 10.0},
    {100.0 / 3.0, 10.0, 0.3},
};

TEST(Grid, IsEveryInstantOfEveryRateOnceAndInOrder) {
  for (const auto& set : kSets) {
    const Grid grid = grid_of(set);
    const Nanoseconds end = std::chrono::seconds(21);
    std::set<Nanoseconds> expected;
    for (const double hz : set) {
      const Rate rate(hz);
      for (std::uint64_t k = 0; rate.at(k) <= end; ++k) expected.insert(rate.at(k));
    }
    std::uint64_t index = 0;
    Nanoseconds t{0};
    for (const Nanoseconds instant : expected) {
      ASSERT_EQ(t, instant) << set[0] << ' ' << index;
      ASSERT_EQ(grid.index(t), index) << set[0];
      ASSERT_TRUE(grid.contains(t));
      ASSERT_EQ(grid.at_or_before(t), t);
      ASSERT_EQ(grid.at_or_after(t), t);
      ASSERT_EQ(grid.at(index), t) << set[0] << ' ' << index;
      const Nanoseconds next = grid.after(t);
      ASSERT_EQ(grid.at_or_before(next - Nanoseconds(1)), t);
      ASSERT_EQ(grid.at_or_after(next - Nanoseconds(1)), next - Nanoseconds(1) == t ? t : next);
      ASSERT_EQ(grid.index(next - Nanoseconds(1)), index);
      t = next;
      ++index;
    }
  }
}

TEST(Grid, DoesNotDriftInADay) {
  const Nanoseconds day = std::chrono::hours(24);
  // 1024 and 10 Hz share the instants of their 2 Hz.
  const Grid odd = grid_of({1024.0, 10.0});
  EXPECT_EQ(odd.index(day), (1024u + 10u - 2u) * 86'400u);
  EXPECT_EQ(odd.at((1024u + 10u - 2u) * 86'400u), day);
  // 1000 and 300 share 100, 300 and 8 share 4, 1000 and 8 all 8.
  const Grid three = grid_of({1000.0, 300.0, 8.0});
  EXPECT_EQ(three.index(day), (1000u + 300u - 100u) * 86'400u);
  EXPECT_EQ(three.at(three.index(day)), day);
  EXPECT_DOUBLE_EQ(three.hz(), 1200.0);
}

TEST(Grid, OfRatesThatDivideIsTheFastest) {
  const Grid grid = grid_of({5.0, 200.0, 50.0, 1.0});
  for (std::uint64_t k = 0; k < 2000; ++k) ASSERT_EQ(grid.at(k), Rate(200.0).at(k));
  EXPECT_EQ(grid.hz(), 200.0);
  EXPECT_EQ(grid.shortest_period_s(), Rate(200.0).period_s());
}

TEST(Grid, RefusesInstantsThatAlmostMeet) {
  EXPECT_NEAR(least_distance_ns(Rate(200.0), Rate(99.9981)), 5.0005, 1e-3);
  EXPECT_NEAR(least_distance_ns(Rate(1024.0), Rate(10.0)), 195312.5, 1e-6);
  EXPECT_NEAR(least_distance_ns(Rate(200.0), Rate(50.0)), 5e6, 1e-3);
  EXPECT_THROW(grid_of({200.0, 99.9981}), std::invalid_argument);
  EXPECT_THROW(grid_of({}), std::invalid_argument);
}

}  // namespace grid_test
}  // namespace inslab::time
