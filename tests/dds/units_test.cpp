#include <gtest/gtest.h>

#include <atomic>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <thread>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"

namespace inslab::dds {
namespace units_test {

ParticipantOptions options(const std::string& name, const std::string& unit) {
  ParticipantOptions options;
  options.name = name;
  options.unit = unit;
  options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
  return options;
}

template <class Condition>
bool eventually(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::yield();
  }
  return true;
}

TEST(Units, ArePatternsForNobody) {
  for (const char* name : {"*", "tr?ck", "[a-z]*", "my car"}) {
    EXPECT_THROW(Participant participant(options("operator", name)), std::runtime_error) << name;
  }
}

/// A stranger is free to have a pattern for a partition; what it writes reaches every unit and is obeyed by none.
TEST(Units, DoNotObeyAWriterWhosePartitionIsAPattern) {
  namespace efd = eprosima::fastdds::dds;
  Participant truck(options("truck", "truck"));
  Participant stranger(options("stranger", ""));
  Participant driver(options("driver", "truck"));
  std::atomic<int> of_stranger{0};
  std::atomic<int> of_driver{0};
  OpenReader<SimCommand> commands(truck, topics::sim_command(), [&](const SimCommand& command, const SampleOrigin&) {
    ++(command.request_id == 1 ? of_stranger : of_driver);
  });
  auto& topic = stranger.topic<SimCommand>("inslab/sim/command");
  efd::PublisherQos everywhere = efd::PUBLISHER_QOS_DEFAULT;
  everywhere.partition().push_back("*");
  efd::Publisher* publisher = stranger.dds().create_publisher(everywhere);
  efd::DataWriter* weapon = publisher->create_datawriter(&topic, writer_qos(Delivery::Request, 10.0));
  Writer<SimCommand> rightful(driver, topics::sim_command());
  const auto reached = [weapon] {
    efd::PublicationMatchedStatus status;
    weapon->get_publication_matched_status(status);
    return status.current_count == 2;
  };
  // It does reach the unit's readers: that is why they must not listen. (Fast DDS 3 can ignore it, 2.9 cannot.)
  ASSERT_TRUE(
      eventually([&] { return reached() && rightful.matched_readers() == 2 && commands.matched_writers() >= 1; }));
  SimCommand stop{1, CommandKind::Stop, 0.0};
  weapon->write(&stop);
  weapon->wait_for_acknowledgments({1, 0});
  ASSERT_TRUE(rightful.write({2, CommandKind::Pause, 0.0}));
  ASSERT_TRUE(eventually([&] { return of_driver == 1; }));
  EXPECT_EQ(of_stranger, 0);
}

}  // namespace units_test
}  // namespace inslab::dds
