#pragma once

#include <fastdds/dds/topic/Topic.hpp>
#include <string>
#include <vector>

#include "inslab/bus/dds/type_adapter.hpp"

namespace inslab::dds {

using Bytes = std::vector<std::uint8_t>;

/// Carries any bytes under the name of a type of ours, as a broken or hostile client of another vendor may.
template <class T>
class AnyBytes : public fast_dds::TopicDataType {
 public:
  explicit AnyBytes(const std::string& name = std::string(catalog::WireType<T>::name)) {
    set_name(name);
    max_serialized_type_size = 65536;
    is_compute_key_provided = generated_type(catalog::WireType<T>::name).is_keyed();
  }
  bool serialize(const void* data, fast_dds::Payload& payload, fast_dds::Representation) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    std::copy(bytes.begin(), bytes.end(), payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(fast_dds::Payload&, void*) override { return false; }
  std::uint32_t calculate_serialized_size(const void* data, fast_dds::Representation) override {
    return static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
  }
  void* create_data() override { return new Bytes(); }
  void delete_data(void* data) override { delete static_cast<Bytes*>(data); }
  bool compute_key(fast_dds::Payload&, fast_dds::Handle&, bool) override { return false; }
  bool compute_key(const void* data, fast_dds::Handle& handle, bool) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    for (std::size_t i = 0; i < 16; ++i) handle.value[i] = i < bytes.size() ? bytes[i] : 0;
    return is_compute_key_provided;
  }
};

}  // namespace inslab::dds
