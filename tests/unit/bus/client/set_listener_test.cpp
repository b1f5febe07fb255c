#include "inslab/bus/client/set_listener.hpp"

#include <gmock/gmock.h>

#include "inslab/bus/client/topic_watch.hpp"

namespace inslab::client {
namespace set_listener_test {

using testing::ElementsAre;
using testing::Pair;

Heartbeats of(const std::string& service, std::uint32_t sensor) {
  Heartbeats heartbeats;
  heartbeats.last.service = service;
  heartbeats.last.sensor_number = sensor;
  return heartbeats;
}

TEST(MissingServices, AreThoseExpectedThatAreNotHeard) {
  EXPECT_THAT(missing_of({{"a", 0}, {"b", 0}, {"b", 1}}, {of("b", 0), of("c", 0)}),
              ElementsAre(Pair("a", 0u), Pair("b", 1u)));
}

TEST(ExpectedServices, OfNoScenarioAreOneOfEach) { EXPECT_EQ(expected_services("").size(), 4u); }

TEST(Intervals, HaveFiguresFromTheSecondMessageOn) {
  Intervals intervals;
  intervals.add(0);
  EXPECT_FALSE(intervals.figures());
  for (const std::int64_t t : {10'000'000, 20'000'000, 40'000'000}) intervals.add(t);
  const auto figures = intervals.figures();
  ASSERT_TRUE(figures);
  EXPECT_EQ(figures->count, 3u);
  EXPECT_NEAR(figures->mean_s, 0.04 / 3, 1e-12);
  EXPECT_DOUBLE_EQ(figures->least_s, 0.01);
  EXPECT_DOUBLE_EQ(figures->most_s, 0.02);
  EXPECT_NEAR(figures->deviation_s, 0.01 * std::sqrt(2.0) / 3.0, 1e-12);  // of 1, 1, 2 times 10 ms
}

}  // namespace set_listener_test
}  // namespace inslab::client
