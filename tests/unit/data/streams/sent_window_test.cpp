#include "inslab/data/streams/sent_window.hpp"

#include <gtest/gtest.h>

#include "inslab/data/samples/gnss_fix.hpp"

namespace inslab::streams {
namespace sent_window_test {

SentWindow<GnssFix> window_with(std::size_t capacity, std::uint64_t first, std::uint64_t end) {
  SentWindow<GnssFix> window(capacity);
  for (std::uint64_t k = first; k < end; ++k) {
    GnssFix fix;
    fix.header.sequence_number = k;
    window.add(fix);
  }
  return window;
}

std::vector<std::uint64_t> numbers(const Block<GnssFix>& block) {
  std::vector<std::uint64_t> list;
  for (const GnssFix& fix : block.samples) list.push_back(fix.header.sequence_number);
  return list;
}

TEST(SentWindow, GivesSamplesAgainFromTheOneAskedFor) {
  const auto window = window_with(10, 0, 6);
  EXPECT_EQ(numbers(window.from(2, 3)), (std::vector<std::uint64_t>{2, 3, 4}));
  EXPECT_EQ(numbers(window.from(5, 3)), (std::vector<std::uint64_t>{5}));
  EXPECT_TRUE(window.from(6, 3).samples.empty());
}

TEST(SentWindow, KeepsNoMoreThanItsCapacityAndGivesTheOldestItHas) {
  const auto window = window_with(4, 0, 100);
  EXPECT_EQ(window.first(), 96U);
  EXPECT_EQ(numbers(window.from(0, 2)), (std::vector<std::uint64_t>{96, 97}));
}

TEST(SentWindow, ForgetsWhatNobodyWantsAgain) {
  auto window = window_with(10, 0, 6);
  window.forget_before(4);
  EXPECT_EQ(window.first(), 4U);
  window.forget_before(100);
  EXPECT_TRUE(window.empty());
}

}  // namespace sent_window_test
}  // namespace inslab::streams
