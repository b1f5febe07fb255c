#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "inslab/bus/dds/fast_dds.hpp"
#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"

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

  std::string name() const { return fast_dds::name_of(*type_); }
  std::uint32_t max_size() const { return fast_dds::max_size_of(*type_); }
  bool is_keyed() const { return fast_dds::is_keyed(*type_); }
  /// Key of a sample given as CDR. False when the generated code refuses the bytes.
  bool key_of(std::vector<std::uint8_t>& cdr, fast_dds::Handle& handle) const;

 private:
  std::unique_ptr<eprosima::fastdds::dds::TopicDataType> type_;
};

/// The generated type of that name. Throws std::out_of_range when idl/ has none.
GeneratedType generated_type(std::string_view type);

/// Lets Fast DDS carry the plain struct T under its IDL type's name, with the codec of common/data/wire, which, unlike
/// the generated one, does not throw on what a hostile writer sends. For Fast DDS a sample is a `void*` made of a `T*`:
/// what is written is any T, what is read into is always a Received<T>.
template <class T>
class TypeAdapter : public fast_dds::TopicDataType {
 public:
  /// `refused` counts the samples whose bytes are no valid T.
  explicit TypeAdapter(
      std::shared_ptr<std::atomic<std::uint32_t>> refused = std::make_shared<std::atomic<std::uint32_t>>())
      : generated_(generated_type(catalog::WireType<T>::name)), refused_(std::move(refused)) {
    set_name(generated_.name());
    max_serialized_type_size = generated_.max_size();
    is_compute_key_provided = generated_.is_keyed();
  }

  bool serialize(const void* data, fast_dds::Payload& payload, fast_dds::Representation) override {
    const auto& value = *static_cast<const T*>(data);
    const std::size_t size = wire::encoded_size(value);
    if (size > payload.max_size) return false;
    wire::encode_to(value, payload.data);
    payload.length = static_cast<std::uint32_t>(size);
    payload.encapsulation = CDR_LE;
    return true;
  }

  bool deserialize(fast_dds::Payload& payload, void* data) override {
    auto& received = static_cast<Received<T>&>(*static_cast<T*>(data));
    T& value = received;
    if (!wire::decode(payload.data, payload.length, value)) {
      refused_->fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    received.cdr.assign(payload.data, payload.data + payload.length);
    return true;
  }

  std::uint32_t calculate_serialized_size(const void* data, fast_dds::Representation) override {
    return static_cast<std::uint32_t>(wire::encoded_size(*static_cast<const T*>(data)));
  }

  void* create_data() override { return static_cast<T*>(new Received<T>()); }
  void delete_data(void* data) override { delete static_cast<Received<T>*>(static_cast<T*>(data)); }

  bool compute_key(fast_dds::Payload& payload, fast_dds::Handle& handle, bool) override {
    if (!is_compute_key_provided) return false;
    T value;  // decoded by our codec first: the generated one may throw
    if (!wire::decode(payload.data, payload.length, value)) return false;
    return key_of(value, handle);
  }
  bool compute_key(const void* data, fast_dds::Handle& handle, bool) override {
    return is_compute_key_provided && key_of(*static_cast<const T*>(data), handle);
  }

  bool is_bounded() const override { return true; }

 private:
  bool key_of(const T& value, fast_dds::Handle& handle) const {
    std::vector<std::uint8_t> cdr;
    wire::encode(value, cdr);
    return generated_.key_of(cdr, handle);
  }

  GeneratedType generated_;
  std::shared_ptr<std::atomic<std::uint32_t>> refused_;
};

/// A new TypeAdapter by the name of its type: the codecs of all are compiled in type_adapter.cpp alone. Throws
/// std::out_of_range when no such type travels.
std::unique_ptr<fast_dds::TopicDataType> type_adapter(std::string_view type,
                                                      const std::shared_ptr<std::atomic<std::uint32_t>>& refused);

}  // namespace inslab::dds
