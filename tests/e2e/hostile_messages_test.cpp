// A client that is broken, or means harm, beside a set in lockstep, where one service that dies would stop all.

#include <gtest/gtest.h>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>

#include "inslab/bus/dds/writer.hpp"
#include "inslab/bus/service/service.hpp"
#include "tests/dds/any_bytes.hpp"
#include "tests/e2e/logged_samples.hpp"
#include "tests/e2e/process.hpp"
#include "tests/unit/foundation/fields/spoiled_fields.hpp"

namespace inslab::e2e {
namespace hostile_messages_test {

using std::chrono::seconds;

/// Writes to the topics that others than our services may write.
class Foe {
 public:
  Foe() : participant_(options()) {}

  /// What no decoder may accept, on one topic.
  template <class T>
  void send_garbage(const dds::Topic<T>& topic) {
    std::vector<dds::Bytes> attacks;
    for (const auto& spoiled : test::SpoiledFields<T>::refused()) {
      attacks.emplace_back();
      wire::encode(spoiled.value, attacks.back());
    }
    send(topic, attacks);
  }
  /// Bytes that are a sample, in which no number is one.
  template <class T>
  void send_without_numbers(const dds::Topic<T>& topic) {
    std::vector<dds::Bytes> attack(1);
    wire::encode(test::SpoiledFields<T>::without_numbers(), attack[0]);
    send(topic, attack);
  }

 private:
  static dds::ParticipantOptions options() {
    service::NetworkOptions network;
    network.domain = static_cast<std::uint32_t>(std::stoul(own_domain()));
    return service::participant_options(network, "foe");
  }

  template <class T>
  void send(const dds::Topic<T>& topic, std::vector<dds::Bytes>& attacks) {
    namespace efd = eprosima::fastdds::dds;
    const std::string type(catalog::WireType<T>::name);
    if (participant_.dds().find_type(type).empty()) {
      ASSERT_EQ(efd::TypeSupport(new dds::AnyBytes<T>()).register_type(&participant_.dds()), efd::RETCODE_OK);
    }
    auto& dds_topic = participant_.topic<T>(topic.name);
    auto* weapon =
        participant_.publisher().create_datawriter(&dds_topic, dds::writer_qos(topic.delivery, topic.nominal_rate_hz));
    ASSERT_NE(weapon, nullptr) << topic.name;
    const auto matched = [weapon] {
      efd::PublicationMatchedStatus status;
      weapon->get_publication_matched_status(status);
      return status.current_count > 0;
    };
    ASSERT_TRUE(eventually(matched, seconds(20))) << topic.name;
    for (dds::Bytes& attack : attacks) weapon->write(&attack);
    weapon->wait_for_acknowledgments({0, 100'000'000});  // what is too large is never acknowledged
    participant_.publisher().delete_datawriter(weapon);
  }

  dds::Participant participant_;
};

TEST(HostileMessages, EndNoServiceAndAreCounted) {
  namespace topics = dds::topics;
  const TestFolder folder;
  Process run("inslab", {"run", source("tests/data/short.json"), "--clock", "lockstep", "--paused", "--domain",
                         own_domain(), "--log", folder / "log.mcap"});
  Process ready("inslab", {"pause", "--domain", own_domain(), "--timeout", "60"});
  ASSERT_EQ(ready.wait(seconds(60)), 0) << ready.output() << run.output();
  {
    Foe foe;
    foe.send_garbage(dds::topics::nav());
    foe.send_garbage(dds::topics::sim_command());
    foe.send_garbage(dds::topics::service_status());
    foe.send_garbage(dds::topics::credit());
    foe.send_garbage(dds::topics::request<ImuErrorProfile>());
    foe.send_garbage(dds::topics::request<VibrationProfile>());
    foe.send_garbage(dds::topics::request<InstallationProfile>());
    foe.send_garbage(dds::topics::request<GnssErrorProfile>());
    foe.send_garbage(dds::topics::request<FaultProfile>());
    foe.send_without_numbers(dds::topics::nav());
    foe.send_without_numbers(dds::topics::request<ImuErrorProfile>());
    foe.send_without_numbers(dds::topics::request<VibrationProfile>());
    foe.send_without_numbers(dds::topics::request<FaultProfile>());
  }
  Process resume("inslab", {"resume", "--domain", own_domain()});
  ASSERT_EQ(resume.wait(seconds(30)), 0) << resume.output() << run.output();
  EXPECT_EQ(run.wait(seconds(60)), 0) << run.output();
  std::map<std::string, std::uint32_t> refused;
  for (const auto& status : samples_of_kind<ServiceStatus>(folder / "log.mcap", "inslab/service_status")) {
    refused[status.service] = status.refused_messages;
  }
  EXPECT_GT(refused["inslab-truth-logger"], 0U);
  EXPECT_GT(refused["inslab-trajectory-server"], 0U);
}

}  // namespace hostile_messages_test
}  // namespace inslab::e2e
