#include "inslab/bus/dds/seen_numbers.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace inslab::dds {
namespace seen_numbers_test {

constexpr SeenSamples::Writer kFirst{1};
constexpr SeenSamples::Writer kSecond{2};

TEST(SeenNumbers, TellsEachNumberOnceHoweverManyCameBefore) {
  SeenNumbers seen;
  for (std::uint64_t n = 1; n <= 20'000; ++n) {
    ASSERT_TRUE(seen.insert(n));
    ASSERT_FALSE(seen.insert(n));
  }
  EXPECT_FALSE(seen.insert(1));
}

TEST(SeenNumbers, TakesWhatFillsAGapOnce) {
  SeenNumbers seen;
  for (const std::uint64_t n : {1, 2, 5, 9, 7}) EXPECT_TRUE(seen.insert(n)) << n;
  for (const std::uint64_t n : {3, 4, 6, 8, 10}) {
    EXPECT_TRUE(seen.insert(n)) << n;
    EXPECT_FALSE(seen.insert(n)) << n;
  }
  for (std::uint64_t n = 1; n <= 10; ++n) EXPECT_FALSE(seen.insert(n)) << n;
}

TEST(SeenNumbers, CountsWhatIsMissingAfterANumberUntilItComes) {
  SeenNumbers seen;
  EXPECT_EQ(seen.last(), 0u);
  for (const std::uint64_t n : {1, 2, 4, 8, 9}) seen.insert(n);
  EXPECT_EQ(seen.last(), 9u);
  EXPECT_EQ(seen.missing_after(0), 4u) << "3, 5, 6, 7";
  EXPECT_EQ(seen.missing_after(2), 4u);
  EXPECT_EQ(seen.missing_after(5), 2u) << "6, 7";
  EXPECT_EQ(seen.missing_after(9), 0u);
  EXPECT_EQ(seen.missing_after(20), 0u);
  seen.insert(6);
  EXPECT_EQ(seen.missing_after(4), 2u);
}

TEST(SeenNumbers, GoOnFromTheRangesOfOthers) {
  SeenNumbers before;
  for (const std::uint64_t n : {1, 2, 4}) before.insert(n);
  SeenNumbers seen(before.ranges());
  for (const std::uint64_t n : {1, 2, 4}) EXPECT_FALSE(seen.insert(n)) << n;
  EXPECT_TRUE(seen.insert(3));
  EXPECT_TRUE(seen.insert(5));
  EXPECT_EQ(seen.ranges(), (SeenNumbers::Ranges{{1, 5}}));
}

TEST(SeenNumbers, AgreesWithASetOfAllNumbersInAnyOrder) {
  std::mt19937_64 random(20261129);
  SeenNumbers seen;
  std::set<std::uint64_t> all;
  for (int i = 0; i < 5000; ++i) {
    const std::uint64_t n = 1 + random() % 400;  // never more gaps than are remembered
    ASSERT_EQ(seen.insert(n), all.insert(n).second) << n;
  }
}

/// A best-effort writer over a bad line: what is forgotten counts as seen, so that nothing is ever told twice.
TEST(SeenNumbers, TellsNothingTwiceHoweverManyGapsThereAre) {
  SeenNumbers seen;
  for (std::uint64_t n = 1; n <= 4000; n += 2) ASSERT_TRUE(seen.insert(n));
  for (std::uint64_t n = 1; n <= 4000; n += 2) ASSERT_FALSE(seen.insert(n)) << n;
  EXPECT_TRUE(seen.insert(3998)) << "a gap among the newest still fills";
}

TEST(SeenNumbers, TakesTheLargest) {
  SeenNumbers seen;
  EXPECT_TRUE(seen.insert(~std::uint64_t{0}));
  EXPECT_FALSE(seen.insert(~std::uint64_t{0}));
  EXPECT_TRUE(seen.insert(0));
}

/// A client that came with its request 1 after another had sent thousands: its number is small, and yet remembered.
TEST(SeenSamples, KeepsTheWritersApart) {
  SeenSamples seen;
  for (std::uint64_t n = 1; n <= 5000; ++n) ASSERT_TRUE(seen.insert(kFirst, n));
  for (std::uint64_t n = 1; n <= 200; ++n) {
    ASSERT_TRUE(seen.insert(kSecond, n));
    ASSERT_FALSE(seen.insert(kSecond, n));
  }
  EXPECT_FALSE(seen.insert(kFirst, 5000));
}

TEST(SeenSamples, ForgetsOfTooManyWritersTheOneThatWasSilentForLongest) {
  SeenSamples seen;
  seen.insert(kFirst, 1);
  for (std::uint8_t high = 0; high < 8; ++high) {
    for (int low = 0; low < 200; ++low) {
      SeenSamples::Writer writer{3, high, static_cast<std::uint8_t>(low)};
      seen.insert(writer, 1);
      ASSERT_FALSE(seen.insert(kFirst, 1)) << "it speaks all the time";
    }
  }
  EXPECT_TRUE(seen.insert(SeenSamples::Writer{3, 0, 0}, 1));
}

}  // namespace seen_numbers_test
}  // namespace inslab::dds
