#include "inslab/data/streams/stream_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace inslab::streams {
namespace stream_monitor_test {

StreamHeader header(std::uint64_t sequence, std::uint8_t run = 1) {
  StreamHeader h;
  h.run_id.bytes.fill(run);
  h.sequence_number = sequence;
  return h;
}

StreamStatus after(const std::vector<std::uint64_t>& sequence) {
  StreamMonitor monitor("inslab/truth", StreamDirection::In);
  for (const std::uint64_t number : sequence) monitor.received(header(number), 0);
  return monitor.status();
}

void expect_counts(const StreamStatus& status, std::uint64_t lost, std::uint64_t out_of_order,
                   std::uint64_t duplicates) {
  EXPECT_EQ(status.lost, lost);
  EXPECT_EQ(status.out_of_order, out_of_order);
  EXPECT_EQ(status.duplicates, duplicates);
}

TEST(StreamMonitor, FindsNothingWrongWithAWholeStream) {
  const StreamStatus status = after({0, 1, 2, 3});
  EXPECT_EQ(status.samples, 4U);
  EXPECT_EQ(status.topic, "inslab/truth");
  expect_counts(status, 0, 0, 0);
}

TEST(StreamMonitor, CountsWhatIsMissingAtTheStartToo) { expect_counts(after({2, 3, 6}), 4, 0, 0); }

TEST(StreamMonitor, TakesALateSampleOffTheLost) {
  expect_counts(after({0, 2, 1, 3}), 0, 1, 0);
  expect_counts(after({0, 5, 3, 2, 6}), 2, 2, 0);
}

TEST(StreamMonitor, ADuplicateDoesNotHideALoss) {
  // 1 is lost and 2 comes twice: the second 2 is no late 1.
  expect_counts(after({0, 2, 2, 3}), 1, 0, 1);
  expect_counts(after({0, 5, 3, 3, 5, 0}), 3, 1, 3);
}

TEST(StreamMonitor, ADuplicateDoesNotStandForASampleThatHasNotCome) {
  StreamMonitor monitor("inslab/truth", StreamDirection::In);
  for (const std::uint64_t number : {0, 2, 2, 3}) monitor.received(header(number), 0);
  EXPECT_EQ(monitor.samples(), 4u);
  EXPECT_EQ(monitor.came(), 3u);
  monitor.received(header(1), 0);
  EXPECT_EQ(monitor.came(), 4u);
}

TEST(StreamMonitor, CountsAnyShuffleRight) {
  std::mt19937_64 engine(8);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint64_t> sequence(300);
    std::iota(sequence.begin(), sequence.end(), 0);
    std::shuffle(sequence.begin(), sequence.end(), engine);
    // Ten are lost, ten come twice; the largest number must come, or its loss could not be known.
    const auto last = std::max_element(sequence.begin(), sequence.end());
    std::iter_swap(sequence.begin(), last);
    sequence.resize(290);
    for (std::size_t i = 0; i < 10; ++i) sequence.push_back(sequence[5 * i]);
    const StreamStatus status = after(sequence);
    ASSERT_EQ(status.samples, 300U);
    ASSERT_EQ(status.lost, 10U);
    ASSERT_EQ(status.duplicates, 10U);
  }
}

TEST(StreamMonitor, BeginsAfreshWithAnotherRun) {
  StreamMonitor monitor("inslab/truth", StreamDirection::In);
  monitor.received(header(0), 0);
  monitor.received(header(7), 0);
  monitor.received(header(0, 2), 0);
  monitor.received(header(1, 2), 0);
  EXPECT_EQ(monitor.samples(), 2U);
  EXPECT_EQ(monitor.next_sequence(), 2U);
  expect_counts(monitor.status(), 0, 0, 0);
}

TEST(StreamMonitor, AnotherProcessGoesOnWithEveryGap) {
  StreamMonitor killed("inslab/imu/0", StreamDirection::In);
  for (const std::uint64_t number : {0, 1, 4, 5, 9}) killed.received(header(number), 0);
  StreamMonitor next("inslab/imu/0", StreamDirection::In);
  next.go_on(header(0).run_id, killed.progress());
  EXPECT_EQ(next.first_missing(), 2u);
  EXPECT_EQ(next.came(), 5u);
  std::vector<std::uint64_t> new_ones;
  for (std::uint64_t number = 0; number <= 10; ++number) {
    if (next.received(header(number), 0)) new_ones.push_back(number);
  }
  EXPECT_EQ(new_ones, (std::vector<std::uint64_t>{2, 3, 6, 7, 8, 10}));
  EXPECT_EQ(next.came(), 11u);
  EXPECT_EQ(next.lost(), 0u);
}

// Of a stream with more gaps than are kept, what lies in those that were given up stays lost.
TEST(StreamMonitor, AnotherProcessKnowsWhatIsLostForGood) {
  StreamMonitor killed("inslab/imu/0", StreamDirection::In);
  for (std::uint64_t i = 0; i < 5000; ++i) killed.received(header(2 * i + 1), 0);
  StreamMonitor next("inslab/imu/0", StreamDirection::In);
  next.go_on(header(0).run_id, killed.progress());
  EXPECT_EQ(next.lost(), 5000u);
  EXPECT_FALSE(next.received(header(0), 0));
  EXPECT_TRUE(next.received(header(9998), 0));
}

TEST(StreamMonitor, SurvivesAStreamThatIsAllGapsAndAHugeNumber) {
  StreamMonitor monitor("inslab/truth", StreamDirection::In);
  for (std::uint64_t i = 0; i < 10000; ++i) monitor.received(header(2 * i + 1), 0);
  EXPECT_EQ(monitor.lost(), 10000U);
  monitor.received(header(std::uint64_t{1} << 63), 0);
  EXPECT_EQ(monitor.lost(), 10000U + (std::uint64_t{1} << 63) - 20000U);
}

TEST(StreamMonitor, MeasuresTheAgeOfSamplesThatSayWhenTheyWereSent) {
  StreamMonitor monitor("inslab/truth", StreamDirection::In);
  StreamHeader sent = header(0);
  sent.publish_realtime_ns = 1'000'000'000;
  monitor.received(sent, 1'000'250'000);
  EXPECT_NEAR(monitor.status().latency_p50_s, 250e-6, 0.01 * 250e-6);
  EXPECT_NEAR(monitor.status().latency_max_s, 250e-6, 1e-12);
  EXPECT_EQ(after({0, 1}).latency_p50_s, -1.0);
}

TEST(StreamMonitor, CountsWhatIsSent) {
  StreamMonitor monitor("inslab/imu/0", StreamDirection::Out);
  monitor.sent();
  monitor.sent();
  EXPECT_EQ(monitor.status().samples, 2U);
  EXPECT_EQ(monitor.status().direction, StreamDirection::Out);
}

}  // namespace stream_monitor_test
}  // namespace inslab::streams
