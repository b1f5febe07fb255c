#include "inslab/bus/dds/qos.hpp"

#include <algorithm>
#include <cmath>

#include "inslab/bus/dds/fast_dds.hpp"

namespace inslab::dds {

namespace efd = eprosima::fastdds::dds;
using eprosima::fastdds::dds::Duration_t;

namespace {

constexpr std::uint32_t kMillisecond_ns = 1'000'000;
const Duration_t kHeartbeatPeriod(0, 20 * kMillisecond_ns);
const Duration_t kResponseDelay(0, 1 * kMillisecond_ns);
constexpr std::int32_t kMaxInstances = 256;
constexpr std::int32_t kJournalSamples = 20'000;
constexpr std::int32_t kAnswers = 5000;
constexpr std::int32_t kReaderSamples = 5000;
constexpr std::int32_t kBlocks = 256;

std::int32_t one_second(double nominal_rate_hz) {
  return std::max<std::int32_t>(512, static_cast<std::int32_t>(std::ceil(nominal_rate_hz)));
}

/// History and limits that both ends share.
template <class Qos>
void set_history(Qos& qos, Delivery delivery, std::int32_t stream_depth) {
  auto& limits = qos.resource_limits();
  if (delivery == Delivery::Latched) {
    qos.history().kind = efd::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = 1;
    limits.max_instances = kMaxInstances;
    limits.max_samples_per_instance = 1;
    limits.max_samples = kMaxInstances;
    limits.allocated_samples = 8;
  } else if (delivery == Delivery::Journal) {
    qos.history().kind = efd::KEEP_ALL_HISTORY_QOS;
    limits.max_instances = kMaxInstances;
    limits.max_samples_per_instance = kJournalSamples;
    limits.max_samples = kMaxInstances * kJournalSamples;
    limits.allocated_samples = 8;
  } else if (delivery == Delivery::Answers) {
    qos.history().kind = efd::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = kAnswers;
    limits.max_instances = 1;
    limits.max_samples_per_instance = kAnswers;
    limits.max_samples = kAnswers;
    limits.allocated_samples = 8;
  } else if (delivery == Delivery::Block) {
    qos.history().kind = efd::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = kBlocks;
    limits.max_instances = 1;
    limits.max_samples_per_instance = kBlocks;
    limits.max_samples = kBlocks;
    limits.allocated_samples = 1;
  } else {
    qos.history().kind = efd::KEEP_LAST_HISTORY_QOS;
    qos.history().depth = stream_depth;
    limits.max_instances = delivery == Delivery::Request ? kMaxInstances : 1;
    limits.max_samples_per_instance = stream_depth;
    limits.max_samples = limits.max_instances * stream_depth;
    limits.allocated_samples = std::min(stream_depth, 128);
  }
}

/// Blocks are tens of kilobytes at most and mostly smaller: no room is kept for the largest.
eprosima::fastdds::rtps::MemoryManagementPolicy_t memory_policy(Delivery delivery) {
  return delivery == Delivery::Block ? eprosima::fastdds::rtps::DYNAMIC_REUSABLE_MEMORY_MODE
                                     : eprosima::fastdds::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}

/// Fast DDS keeps for each reader a list of what the reader still lacks. It is as long as `allocated_samples` from the
/// start and grows by one entry at a time, copied anew each time, while all discovery waits: a reader that came when
/// 20,000 swaps had been made held the trajectory server up for minutes, and nobody found it. So the list has its full
/// length from the start, which costs addresses and no memory; nor are samples allocated before there are any.
void expect_late_readers(efd::DataWriterQos& qos, Delivery delivery) {
  if (delivery == Delivery::Journal) {
    qos.resource_limits().allocated_samples = kJournalSamples;
  } else if (delivery == Delivery::Answers) {
    // Equal to the limit it would be a list of fixed length.
    qos.resource_limits().allocated_samples = kAnswers - 1;
  } else {
    return;
  }
  qos.endpoint().history_memory_policy = eprosima::fastdds::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
}

bool is_latched(Delivery delivery) {
  return delivery == Delivery::Latched || delivery == Delivery::Journal || delivery == Delivery::Answers;
}

}  // namespace

efd::DataWriterQos writer_qos(Delivery delivery, double nominal_rate_hz, bool is_kept) {
  efd::DataWriterQos qos = efd::DATAWRITER_QOS_DEFAULT;
  qos.reliability().kind = efd::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = Duration_t(0, 100 * kMillisecond_ns);
  qos.durability().kind =
      is_kept || is_latched(delivery) ? efd::TRANSIENT_LOCAL_DURABILITY_QOS : efd::VOLATILE_DURABILITY_QOS;
  qos.publish_mode().kind = efd::SYNCHRONOUS_PUBLISH_MODE;
  // Data sharing crashes, hangs at teardown and loses latched data in 2.9.
  qos.data_sharing().off();
  set_history(qos, delivery, one_second(nominal_rate_hz));
  fast_dds::set_times(qos, kHeartbeatPeriod, kResponseDelay);
  qos.representation().m_value = {efd::XCDR_DATA_REPRESENTATION};
  qos.endpoint().history_memory_policy = memory_policy(delivery);
  expect_late_readers(qos, delivery);
  return qos;
}

efd::DataReaderQos reader_qos(Delivery delivery, double nominal_rate_hz, Reliability reliability, bool is_kept) {
  efd::DataReaderQos qos = efd::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind =
      reliability == Reliability::Reliable ? efd::RELIABLE_RELIABILITY_QOS : efd::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      is_kept || is_latched(delivery) ? efd::TRANSIENT_LOCAL_DURABILITY_QOS : efd::VOLATILE_DURABILITY_QOS;
  qos.data_sharing().off();
  set_history(qos, delivery, std::max(kReaderSamples, one_second(nominal_rate_hz)));
  fast_dds::set_times(qos, kResponseDelay);
  fast_dds::representation(qos).m_value = {efd::XCDR_DATA_REPRESENTATION};
  qos.endpoint().history_memory_policy = memory_policy(delivery);
  return qos;
}

}  // namespace inslab::dds
