#include "inslab/bus/dds/announcements.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "inslab/bus/dds/fast_dds_network.hpp"
#include "inslab/bus/dds/participant.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/typed_topics.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "inslab/data/samples/truth_state.hpp"

namespace inslab::dds {
namespace announcements_test {

/// Counts what it hears of others' endpoints.
struct Ear : fast_dds::DomainParticipantListener {
  void on_data_writer_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::WriterStatus,
                                const fast_dds::PublicationData&, bool&) override {
    ++writers;
  }
  void on_data_reader_discovery(eprosima::fastdds::dds::DomainParticipant*, fast_dds::ReaderStatus,
                                const fast_dds::SubscriptionData&, bool&) override {
    ++readers;
  }
  std::atomic<int> writers{0};
  std::atomic<int> readers{0};
};

bool reach(const std::atomic<int>& count, int wanted) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (count < wanted && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return count == wanted;
}

TEST(Announcements, ThatAreRepeatedAreHeardAgainByThoseWhoKnewThem) {
  ParticipantOptions options;
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  Participant listening(options);
  Ear ear;
  listening.dds().set_listener(&ear);
  Participant speaking(options);
  Writer<TruthState> writer(speaking, topics::truth());
  const Reader<TruthState> reader(speaking, topics::truth(), [](const TruthState&, const SampleOrigin&) {});
  ASSERT_TRUE(reach(ear.writers, 1));
  ASSERT_TRUE(reach(ear.readers, 1));
  speaking.announcements().repeat();
  EXPECT_TRUE(reach(ear.writers, 2)) << ear.writers;
  EXPECT_TRUE(reach(ear.readers, 2)) << ear.readers;
  EXPECT_EQ(writer.matched_readers(), 1);
  EXPECT_EQ(reader.matched_writers(), 1);
  listening.dds().set_listener(nullptr);
}

}  // namespace announcements_test
}  // namespace inslab::dds
