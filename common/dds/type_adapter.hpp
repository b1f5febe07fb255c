#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <vector>

#include "wire/cdr.hpp"
#include "wire/wire_type.hpp"

namespace inslab::dds {

/// A sample as it was received: the struct, and the bytes that came over the wire, encapsulation included.
template <class T>
struct Received : T {
  std::vector<std::uint8_t> cdr;
};

/// Name, largest size and key of an IDL type, from the generated code.
class GeneratedType {
 public:
  explicit GeneratedType(std::unique_ptr<eprosima::fastdds::dds::TopicDataType> type) : type_(std::move(type)) {}

  const char* name() const { return type_->getName(); }
  std::uint32_t max_size() const { return type_->m_typeSize; }
  bool is_keyed() const { return type_->m_isGetKeyDefined; }
  /// Key of a sample given as CDR. False when the generated code refuses the bytes.
  bool key_of(std::vector<std::uint8_t>& cdr, eprosima::fastrtps::rtps::InstanceHandle_t& handle) const;

 private:
  std::unique_ptr<eprosima::fastdds::dds::TopicDataType> type_;
};

/// The generated type of a plain struct. Defined in type_adapter.cpp for every WireType.
template <class T>
GeneratedType generated_type();

/// Lets Fast DDS carry the plain struct T under its IDL type's name, with the codec of common/wire, which, unlike the
/// generated one, does not throw on what a hostile writer sends. For Fast DDS a sample is a `void*` made of a `T*`:
/// what is written is any T, what is read into is always a Received<T>.
template <class T>
class TypeAdapter : public eprosima::fastdds::dds::TopicDataType {
 public:
  /// `refused` counts the samples whose bytes are no valid T.
  explicit TypeAdapter(
      std::shared_ptr<std::atomic<std::uint32_t>> refused = std::make_shared<std::atomic<std::uint32_t>>())
      : generated_(generated_type<T>()), refused_(std::move(refused)) {
    setName(generated_.name());
    m_typeSize = generated_.max_size();
    m_isGetKeyDefined = generated_.is_keyed();
    // Cyclone DDS 0.10 rejects the TypeInformation that 2.9 would send, and would not see our writers at all.
    auto_fill_type_information(false);
    auto_fill_type_object(false);
  }

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& value = *static_cast<const T*>(data);
    const std::size_t size = wire::encoded_size(value);
    if (size > payload->max_size) return false;
    wire::encode_to(value, payload->data);
    payload->length = static_cast<std::uint32_t>(size);
    payload->encapsulation = CDR_LE;
    return true;
  }

  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    auto& received = static_cast<Received<T>&>(*static_cast<T*>(data));
    T& value = received;
    if (!wire::decode(payload->data, payload->length, value)) {
      refused_->fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    received.cdr.assign(payload->data, payload->data + payload->length);
    return true;
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [value = static_cast<const T*>(data)] { return static_cast<std::uint32_t>(wire::encoded_size(*value)); };
  }

  void* createData() override { return static_cast<T*>(new Received<T>()); }
  void deleteData(void* data) override { delete static_cast<Received<T>*>(static_cast<T*>(data)); }

  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    if (!m_isGetKeyDefined) return false;
    std::vector<std::uint8_t> cdr;
    wire::encode(*static_cast<const T*>(data), cdr);
    return generated_.key_of(cdr, *handle);
  }

  bool is_bounded() const override { return true; }

 private:
  GeneratedType generated_;
  std::shared_ptr<std::atomic<std::uint32_t>> refused_;
};

}  // namespace inslab::dds
