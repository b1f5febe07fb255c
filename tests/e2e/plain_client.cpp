// A flight computer's app at its smallest: Fast DDS, the types generated from idl/imu.idl, and nothing else of the
// simulator. Prints how many samples came and how many sequence numbers are missing.
//
//   plain_client DOMAIN SECONDS
#include <chrono>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <iostream>

#include "imuPubSubTypes.h"

using namespace eprosima::fastdds::dds;

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: plain_client DOMAIN SECONDS\n";
    return 2;
  }
  auto* factory = DomainParticipantFactory::get_instance();
  // PARTICIPANT_QOS_DEFAULT is what FASTRTPS_DEFAULT_PROFILES_FILE says, if it is set.
  auto* participant = factory->create_participant(static_cast<DomainId_t>(std::atoi(argv[1])), PARTICIPANT_QOS_DEFAULT);
  TypeSupport type(new inslab::ImuSamplePubSubType());
  type.register_type(participant);
  auto* topic = participant->create_topic("inslab/imu/0", type.get_type_name(), TOPIC_QOS_DEFAULT);
  auto* subscriber = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  DataReaderQos reader_qos = DATAREADER_QOS_DEFAULT;
  reader_qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
  reader_qos.history().depth = 500;
  auto* reader = subscriber->create_datareader(topic, reader_qos);

  std::uint64_t received = 0;
  std::uint64_t next = 0;
  std::uint64_t missing = 0;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::atoi(argv[2]));
  while (std::chrono::steady_clock::now() < end) {
    reader->wait_for_unread_message(eprosima::fastrtps::Duration_t(0, 100'000'000));
    inslab::ImuSample sample;
    SampleInfo info;
    while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      ++received;
      missing += sample.header().sequence_number() - next;
      next = sample.header().sequence_number() + 1;
    }
  }
  std::cout << received << " samples, " << missing << " missing\n";
  participant->delete_contained_entities();
  factory->delete_participant(participant);
  return 0;
}
