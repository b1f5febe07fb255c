#include "inslab/formats/log/log_info.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/formats/log/log_channel.hpp"
#include "tests/unit/formats/recordings/temporary_folder.hpp"

namespace inslab::log {
namespace log_info_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class LogInfoOf : public test::TemporaryFolder {
 protected:
  static TruthState truth(std::uint64_t k, std::uint8_t run = 1) {
    TruthState sample;
    sample.header.run_id.bytes.fill(run);
    sample.header.sequence_number = k;
    sample.header.sim_time_ns = static_cast<std::int64_t>(5'000'000 * k);
    return sample;
  }
  void log(const std::vector<TruthState>& samples) const {
    mcap::McapWriter writer(path("run.mcap"));
    LogChannel<TruthState> channel(writer, "inslab/truth");
    for (const TruthState& sample : samples) channel.write(sample, 0, 0, 0);
    writer.close();
  }
};

TEST_F(LogInfoOf, AWholeStreamHasCountTypeTimesAndRate) {
  std::vector<TruthState> samples;
  for (std::uint64_t k = 0; k <= 1000; ++k) samples.push_back(truth(k));
  log(samples);

  const LogInfo info = inspect_log(path("run.mcap"));
  EXPECT_TRUE(info.closed_properly);
  EXPECT_EQ(info.message_count, 1001u);
  EXPECT_THAT(info.run_ids, ElementsAre("01010101010101010101010101010101"));
  ASSERT_EQ(info.topics.size(), 1u);
  const TopicInfo& topic = info.topics[0];
  EXPECT_EQ(topic.topic, "inslab/truth");
  EXPECT_EQ(topic.type, "inslab::v5::TruthState");
  EXPECT_EQ(topic.count, 1001u);
  EXPECT_EQ(topic.first_sim_time_ns, 0);
  EXPECT_EQ(topic.last_sim_time_ns, 5'000'000'000);
  ASSERT_TRUE(topic.rate_hz.has_value());
  EXPECT_DOUBLE_EQ(*topic.rate_hz, 200.0);
  EXPECT_TRUE(topic.is_numbered);
  EXPECT_THAT(topic.gaps, IsEmpty());
}

TEST_F(LogInfoOf, AStreamWithFaultsNamesThem) {
  log({truth(0), truth(1), truth(4), truth(3), truth(4)});

  const TopicInfo topic = inspect_log(path("run.mcap")).topics.at(0);
  EXPECT_THAT(topic.gaps, ElementsAre(SequenceGap{2, 2, 5'000'000}));
  EXPECT_EQ(topic.missing, 1u);
  EXPECT_EQ(topic.out_of_order, 1u);
  EXPECT_EQ(topic.duplicates, 1u);
}

TEST_F(LogInfoOf, TwoRunsCountsEachFromZero) {
  log({truth(0), truth(1), truth(0, 2), truth(1, 2)});

  const LogInfo info = inspect_log(path("run.mcap"));
  EXPECT_EQ(info.run_ids.size(), 2u);
  EXPECT_EQ(info.topics.at(0).duplicates, 0u);
  EXPECT_EQ(info.topics.at(0).missing, 0u);
}

TEST_F(LogInfoOf, AnAppWithoutHeaderIsNotNumbered) {
  mcap::McapWriter writer(path("run.mcap"));
  LogChannel<NavSolution>(writer, "inslab/nav").write(NavSolution(), 0, 0, 0);
  writer.close();

  const TopicInfo topic = inspect_log(path("run.mcap")).topics.at(0);
  EXPECT_FALSE(topic.is_numbered);
  EXPECT_FALSE(topic.first_sim_time_ns.has_value());
  EXPECT_FALSE(topic.rate_hz.has_value());
}

TEST_F(LogInfoOf, MessagesThatAreNotTheirTypeAreCounted) {
  mcap::McapWriter writer(path("run.mcap"));
  LogChannel<TruthState> channel(writer, "inslab/truth");
  channel.write(truth(0), 0, 0, 0);
  const std::uint8_t garbage[] = {1, 2, 3};
  writer.write(0, 1, 1, 1, garbage, sizeof(garbage));
  writer.close();

  const TopicInfo topic = inspect_log(path("run.mcap")).topics.at(0);
  EXPECT_EQ(topic.count, 2u);
  EXPECT_EQ(topic.unreadable, 1u);
}

TEST_F(LogInfoOf, AKilledWriterSaysSo) {
  mcap::McapWriter writer(path("run.mcap"));
  LogChannel<TruthState> channel(writer, "inslab/truth");
  channel.write(truth(0), 0, 0, 0);
  writer.flush();

  const LogInfo info = inspect_log(path("run.mcap"));
  EXPECT_FALSE(info.closed_properly);
  EXPECT_THAT(info.ending, HasSubstr("did not close"));
  EXPECT_EQ(info.topics.at(0).count, 1u);
}

}  // namespace log_info_test
}  // namespace inslab::log
