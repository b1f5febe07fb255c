#pragma once

/// The place that tells the Fast DDS of Debian 12 (2.9) and of Debian 13 (3.1) apart; bus/dds/fast_dds_network.hpp does
/// so for transports and for what is heard of others. All other code uses the names and signatures of 3.x.

#include <cstdint>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <memory>
#include <string>

#if __has_include(<fastdds/utils/IPLocator.hpp>)
#define INSLAB_FAST_DDS_3
#else
#include <fastrtps/types/TypesBase.h>
#endif

#ifndef INSLAB_FAST_DDS_3

// NOLINTBEGIN(misc-unused-using-decls): these are for those who include this.
namespace eprosima::fastdds::rtps {
using fastrtps::rtps::GUID_t;
using fastrtps::rtps::InstanceHandle_t;
using fastrtps::rtps::SerializedPayload_t;
using MemoryManagementPolicy_t = fastrtps::rtps::MemoryManagementPolicy_t;
using fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
using fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
}  // namespace eprosima::fastdds::rtps

namespace eprosima::fastdds::dds {
using fastrtps::Duration_t;
constexpr auto RETCODE_OK = fastrtps::types::ReturnCode_t::RETCODE_OK;
}  // namespace eprosima::fastdds::dds
// NOLINTEND(misc-unused-using-decls)

#endif

namespace inslab::dds::fast_dds {

/// Name of the environment variable in which this Fast DDS looks for XML profiles, and its name in the other line.
#ifdef INSLAB_FAST_DDS_3
constexpr const char* kProfilesVariable = "FASTDDS_DEFAULT_PROFILES_FILE";
constexpr const char* kOtherProfilesVariable = "FASTRTPS_DEFAULT_PROFILES_FILE";
constexpr const char* kVersion = FASTDDS_VERSION_STR;
/// Whether of two readers of a topic in one participant with keys only the first gets a sample as it comes. The other
/// asks for it again if it is reliable; 3.1.2 says of it that it could not be decrypted, in two errors.
constexpr bool kSecuredSampleComesToOneReader = true;
#else
constexpr const char* kProfilesVariable = "FASTRTPS_DEFAULT_PROFILES_FILE";
constexpr const char* kOtherProfilesVariable = "FASTDDS_DEFAULT_PROFILES_FILE";
constexpr const char* kVersion = FASTRTPS_VERSION_STR;
constexpr bool kSecuredSampleComesToOneReader = false;
#endif

using Payload = eprosima::fastdds::rtps::SerializedPayload_t;
using Handle = eprosima::fastdds::rtps::InstanceHandle_t;
using Representation = eprosima::fastdds::dds::DataRepresentationId_t;

#ifdef INSLAB_FAST_DDS_3

/// A type that describes itself to nobody: Fast DDS sends no TypeInformation of it.
using TopicDataType = eprosima::fastdds::dds::TopicDataType;

inline void set_times(eprosima::fastdds::dds::DataWriterQos& qos, const eprosima::fastdds::dds::Duration_t& heartbeat,
                      const eprosima::fastdds::dds::Duration_t& nack_response) {
  qos.reliable_writer_qos().times.heartbeat_period = heartbeat;
  qos.reliable_writer_qos().times.nack_response_delay = nack_response;
}
inline void set_times(eprosima::fastdds::dds::DataReaderQos& qos,
                      const eprosima::fastdds::dds::Duration_t& heartbeat_response) {
  qos.reliable_reader_qos().times.heartbeat_response_delay = heartbeat_response;
}

inline eprosima::fastdds::dds::DataRepresentationQosPolicy& representation(eprosima::fastdds::dds::DataReaderQos& qos) {
  return qos.representation();
}

// Of generated types.
inline std::string name_of(const eprosima::fastdds::dds::TopicDataType& type) { return type.get_name(); }
inline std::uint32_t max_size_of(const eprosima::fastdds::dds::TopicDataType& type) {
  return type.max_serialized_type_size;
}
inline bool is_keyed(const eprosima::fastdds::dds::TopicDataType& type) { return type.is_compute_key_provided; }
inline bool key_of(eprosima::fastdds::dds::TopicDataType& type, Payload& payload, Handle& handle) {
  return type.compute_key(payload, handle, false);
}
inline bool serialize(eprosima::fastdds::dds::TopicDataType& type, const void* data, Payload& payload) {
  return type.serialize(data, payload, eprosima::fastdds::dds::XCDR_DATA_REPRESENTATION);
}
inline bool deserialize(eprosima::fastdds::dds::TopicDataType& type, Payload& payload, void* data) {
  return type.deserialize(payload, data);
}
/// A sample for such a type, which must outlive it.
inline std::shared_ptr<void> sample_of(eprosima::fastdds::dds::TopicDataType& type) {
  return {type.create_data(), [&type](void* sample) { type.delete_data(sample); }};
}

#else

/// A type with the functions of 3.x that describes itself to nobody: Cyclone DDS 0.10 rejects the TypeInformation that
/// 2.9 would send, and would not see our writers at all.
class TopicDataType : public eprosima::fastdds::dds::TopicDataType {
 public:
  TopicDataType() {
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  virtual bool serialize(const void* data, Payload& payload, Representation representation) = 0;
  virtual bool deserialize(Payload& payload, void* data) = 0;
  virtual std::uint32_t calculate_serialized_size(const void* data, Representation representation) = 0;
  virtual void* create_data() = 0;
  virtual void delete_data(void* data) = 0;
  virtual bool compute_key(Payload& payload, Handle& handle, bool force_md5) = 0;
  virtual bool compute_key(const void* data, Handle& handle, bool force_md5) = 0;

  void set_name(const std::string& name) { setName(name.c_str()); }
  std::uint32_t& max_serialized_type_size = m_typeSize;
  bool& is_compute_key_provided = m_isGetKeyDefined;

 private:
  static constexpr Representation kXcdr1 = eprosima::fastdds::dds::XCDR_DATA_REPRESENTATION;
  bool serialize(void* data, Payload* payload) final { return serialize(data, *payload, kXcdr1); }
  bool deserialize(Payload* payload, void* data) final { return deserialize(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) final {
    return [this, data] { return calculate_serialized_size(data, kXcdr1); };
  }
  void* createData() final { return create_data(); }
  void deleteData(void* data) final { delete_data(data); }
  bool getKey(void* data, Handle* handle, bool force_md5) final { return compute_key(data, *handle, force_md5); }
};

inline void set_times(eprosima::fastdds::dds::DataWriterQos& qos, const eprosima::fastdds::dds::Duration_t& heartbeat,
                      const eprosima::fastdds::dds::Duration_t& nack_response) {
  qos.reliable_writer_qos().times.heartbeatPeriod = heartbeat;
  qos.reliable_writer_qos().times.nackResponseDelay = nack_response;
}
inline void set_times(eprosima::fastdds::dds::DataReaderQos& qos,
                      const eprosima::fastdds::dds::Duration_t& heartbeat_response) {
  qos.reliable_reader_qos().times.heartbeatResponseDelay = heartbeat_response;
}

inline eprosima::fastdds::dds::DataRepresentationQosPolicy& representation(eprosima::fastdds::dds::DataReaderQos& qos) {
  return qos.type_consistency().representation;
}

// Of generated types.
inline std::string name_of(const eprosima::fastdds::dds::TopicDataType& type) { return type.getName(); }
inline std::uint32_t max_size_of(const eprosima::fastdds::dds::TopicDataType& type) { return type.m_typeSize; }
inline bool is_keyed(const eprosima::fastdds::dds::TopicDataType& type) { return type.m_isGetKeyDefined; }
inline std::shared_ptr<void> sample_of(eprosima::fastdds::dds::TopicDataType& type) {
  return {type.createData(), [&type](void* sample) { type.deleteData(sample); }};
}
inline bool key_of(eprosima::fastdds::dds::TopicDataType& type, Payload& payload, Handle& handle) {
  const std::shared_ptr<void> sample = sample_of(type);
  return type.deserialize(&payload, sample.get()) && type.getKey(sample.get(), &handle, false);
}
inline bool serialize(eprosima::fastdds::dds::TopicDataType& type, void* data, Payload& payload) {
  return type.serialize(data, &payload);
}
inline bool deserialize(eprosima::fastdds::dds::TopicDataType& type, Payload& payload, void* data) {
  return type.deserialize(&payload, data);
}

#endif

}  // namespace inslab::dds::fast_dds
