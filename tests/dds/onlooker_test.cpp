#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/dds/writer.hpp"

namespace inslab::dds {
namespace onlooker_test {

ParticipantOptions on_own_domain(const char* name) {
  ParticipantOptions options;
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  options.name = name;
  return options;
}

/// A reader may be matched before its participant's announcement has come.
TEST(Onlooker, HasReadersThatCountForNobodyNotEvenAtFirst) {
  Participant participant(on_own_domain("producer"));
  ParticipantOptions options = on_own_domain("onlooker");
  options.looks_on = true;
  for (int round = 0; round < 5; ++round) {
    Writer<TruthState> writer(participant, topics::truth());
    Participant looks_on(options);
    const Reader<TruthState> reader(looks_on, topics::truth(), [](const TruthState&, const SampleOrigin&) {});
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (writer.matched_readers_of(looks_on.key()) == 0) {
      ASSERT_EQ(writer.matched_readers(), 0);
      ASSERT_LT(std::chrono::steady_clock::now(), deadline);
      std::this_thread::yield();
    }
    EXPECT_EQ(writer.matched_readers(), 0);
  }
}

TEST(Onlooker, LeavesTheReadersOfOthersCounted) {
  Participant participant(on_own_domain("producer"));
  Writer<TruthState> writer(participant, topics::truth());
  const auto take = [](const TruthState&, const SampleOrigin&) {};
  const Reader<TruthState> own(participant, topics::truth(), take);
  Participant other(on_own_domain("consumer"));
  const Reader<TruthState> reader(other, topics::truth(), take);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (writer.matched_readers() < 2) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::yield();
  }
  EXPECT_EQ(writer.matched_readers_of(other.key()), 1);
  EXPECT_EQ(writer.matched_readers_of(participant.key()), 1);
}

}  // namespace onlooker_test
}  // namespace inslab::dds
