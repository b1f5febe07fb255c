#include "inslab/formats/log/log_walk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/formats/log/log_channel.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::log {
namespace log_walk_test {

using ::testing::ElementsAre;

/// A log of three truths and two fixes of two receivers, as they are written: t0 f0 t1 t2 f1.
class LogWalkOver : public test::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    mcap::McapWriter writer(path("run.mcap"));
    LogChannel<TruthState> truths(writer, "inslab/truth");
    LogChannel<GnssFix> first(writer, "inslab/gnss/0"), second(writer, "inslab/gnss/1");
    const auto put = [](auto& channel, auto sample, std::int64_t t) {
      sample.header.sim_time_ns = t;
      channel.write(sample, 0, static_cast<std::uint64_t>(100 + t), 0);
    };
    put(truths, TruthState(), 0);
    put(first, GnssFix(), 0);
    put(truths, TruthState(), 1);
    put(truths, TruthState(), 2);
    put(second, GnssFix(), 1);
    writer.close();
  }
};

TEST_F(LogWalkOver, GivesEachSampleToThoseWhoAskedInTheOrderOfTheLog) {
  const mcap::McapReader log(path("run.mcap"));
  std::vector<std::string> heard;
  LogWalk walk(log);
  walk.each<TruthState>([&](const TruthState& s) { heard.push_back("a t" + std::to_string(s.header.sim_time_ns)); });
  walk.each<GnssFix>([&](const GnssFix& s, const LogWalk::Place& place) {
    heard.push_back(place.topic + " at " + std::to_string(place.log_time_ns) + " f" +
                    std::to_string(s.header.sim_time_ns));
  });
  walk.each<TruthState>([&](const TruthState& s) { heard.push_back("b t" + std::to_string(s.header.sim_time_ns)); });
  walk.go();
  EXPECT_THAT(heard, ElementsAre("a t0", "b t0", "inslab/gnss/0 at 100 f0", "a t1", "b t1", "a t2", "b t2",
                                 "inslab/gnss/1 at 101 f1"));
}

TEST_F(LogWalkOver, CountsTheMessagesOfATopic) {
  const mcap::McapReader log(path("run.mcap"));
  std::size_t messages = 0;
  LogWalk walk(log);
  walk.each_message("inslab/truth", [&] { ++messages; });
  walk.go();
  EXPECT_EQ(messages, 3u);
}

TEST_F(LogWalkOver, LeavesOutWhatIsNotWhatItsTypeSays) {
  mcap::McapWriter writer(path("bad.mcap"));
  LogChannel<TruthState> channel(writer, "inslab/truth");
  channel.write(TruthState(), 0, 0, 0);
  const std::uint8_t torn[] = {0, 1, 0, 0, 7};
  writer.write(channel.id(), 1, 0, 0, torn, sizeof(torn));
  writer.close();
  const mcap::McapReader log(path("bad.mcap"));
  std::size_t truths = 0, messages = 0;
  LogWalk walk(log);
  walk.each<TruthState>([&](const TruthState&) { ++truths; });
  walk.each_message("inslab/truth", [&] { ++messages; });
  walk.go();
  EXPECT_EQ(truths, 1u);
  EXPECT_EQ(messages, 2u);
}

}  // namespace log_walk_test
}  // namespace inslab::log
