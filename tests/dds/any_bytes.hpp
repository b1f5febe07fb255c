#pragma once

#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>
#include <vector>

#include "dds/type_adapter.hpp"

namespace inslab::dds {

using Bytes = std::vector<std::uint8_t>;

/// Carries any bytes under the name of a type of ours, as a broken or hostile client of another vendor may.
template <class T>
class AnyBytes : public eprosima::fastdds::dds::TopicDataType {
 public:
  AnyBytes() {
    setName(std::string(wire::WireType<T>::name).c_str());
    m_typeSize = 65536;
    m_isGetKeyDefined = generated_type<T>().is_keyed();
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t*, void*) override { return false; }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes(); }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    for (std::size_t i = 0; i < 16; ++i) handle->value[i] = i < bytes.size() ? bytes[i] : 0;
    return m_isGetKeyDefined;
  }
};

}  // namespace inslab::dds
