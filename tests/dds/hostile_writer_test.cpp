#include <gtest/gtest.h>

#include <condition_variable>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <random>
#include <thread>

#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/dds/writer.hpp"
#include "tests/dds/any_bytes.hpp"
#include "tests/unit/foundation/fields/spoiled_fields.hpp"

namespace inslab::dds {
namespace hostile_writer_test {

template <class T>
class HostileWriter : public testing::Test {
 protected:
  static ParticipantOptions options(const char* name) {
    ParticipantOptions options;
    options.name = name;
    options.domain = 40 + static_cast<std::uint32_t>(getpid() % 150);
    return options;
  }

  /// Sends bytes of a hostile writer, then one good sample; true when the good one arrives and refusals were counted.
  /// The two may come in either order: two readers take them.
  bool survives(const std::vector<Bytes>& attacks) {
    Participant victim_participant(options("victim"));
    Participant attacker(options("attacker"));
    Participant friend_participant(options("friend"));
    const Topic<T> topic{"inslab/attacked", Delivery::Request, 100.0};

    std::mutex mutex;
    std::condition_variable arrived;
    bool good_arrived = false;
    T good;
    Bytes good_bytes;
    wire::encode(good, good_bytes);
    OpenReader<T> victim(victim_participant, topic, [&](const Received<T>& sample, const SampleOrigin&) {
      const std::lock_guard<std::mutex> lock(mutex);
      good_arrived = good_arrived || sample.cdr == good_bytes;
      arrived.notify_all();
    });

    eprosima::fastdds::dds::TypeSupport type(new AnyBytes<T>());
    EXPECT_EQ(type.register_type(&attacker.dds()), eprosima::fastdds::dds::RETCODE_OK);
    auto& dds_topic = attacker.topic<T>(topic.name);  // finds the type registered under that name: the weapon's
    auto* weapon = attacker.publisher().create_datawriter(&dds_topic, writer_qos(Delivery::Request, 100.0));
    Writer<T> honest(friend_participant, topic);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    // The weapon, too, must know both readers: what it sends before is for nobody.
    const auto targets = [weapon] {
      eprosima::fastdds::dds::PublicationMatchedStatus status;
      weapon->get_publication_matched_status(status);
      return status.current_count;
    };
    while (victim.matched_writers() < 2 || honest.matched_readers() < 2 || targets() < 2) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      std::this_thread::yield();
    }
    for (Bytes attack : attacks) weapon->write(&attack);
    // Fast DDS never acknowledges what is larger than the type can be: that is the attacker's own loss.
    weapon->wait_for_acknowledgments(eprosima::fastdds::dds::Duration_t(0, 200'000'000));
    honest.write(good);
    std::unique_lock<std::mutex> lock(mutex);
    const bool survived = arrived.wait_for(lock, std::chrono::seconds(20), [&] { return good_arrived; });
    lock.unlock();
    const auto counted = [&] { return victim_participant.refused_messages() > 0; };
    while (!counted() && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
    EXPECT_TRUE(counted());
    attacker.publisher().delete_datawriter(weapon);
    return survived;
  }

  static Bytes good_cdr() {
    Bytes bytes;
    wire::encode(T{}, bytes);
    return bytes;
  }
};

/// Every topic that anybody reads, and with blocks lists of samples as well.
using AttackedTypes = Applied<testing::Types, catalog::TravellingTypes>;
TYPED_TEST_SUITE(HostileWriter, AttackedTypes);

/// One participant is attacked in every way: making three of them for each way would take most of the time.
TYPED_TEST(HostileWriter, CostsNothingElseAndIsCounted) {
  std::vector<Bytes> attacks;
  const Bytes whole = this->good_cdr();
  for (std::size_t size = 1; size < std::min<std::size_t>(whole.size(), 40); ++size) {
    attacks.emplace_back(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
  }
  for (const int representation : {0x02, 0x03, 0x06, 0x07, 0x08, 0x09, 0x0a, 0x0b, 0xff}) {
    attacks.push_back(whole);
    attacks.back()[1] = static_cast<std::uint8_t>(representation);
  }
  std::mt19937 random(20261122);
  for (std::size_t i = 0; i < 50; ++i) {
    Bytes bytes(4 + random() % 2000);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    bytes[0] = 0;
    bytes[1] = static_cast<std::uint8_t>(random() % 2);
    attacks.push_back(bytes);
  }
  for (const auto& spoiled : test::SpoiledFields<TypeParam>::refused()) {
    attacks.emplace_back();
    wire::encode(spoiled.value, attacks.back());
  }
  attacks.emplace_back();
  wire::encode(test::SpoiledFields<TypeParam>::without_numbers(), attacks.back());
  EXPECT_TRUE(this->survives(attacks));
}

}  // namespace hostile_writer_test
}  // namespace inslab::dds
