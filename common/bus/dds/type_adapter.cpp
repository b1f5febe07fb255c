// The generated headers come first: they name their types without a namespace, which would be ambiguous after ours.
// clang-format off
#include "generated_types.hpp"
// clang-format on

#include "inslab/bus/dds/type_adapter.hpp"

#include <mutex>
#include <stdexcept>

namespace inslab::dds {

namespace {

constexpr bool stands_in_idl(std::string_view type) {
  for (const idl::GeneratedStruct& one : idl::kStructs) {
    if (one.name == type) return true;
  }
  return false;
}

std::out_of_range unknown(std::string_view type) {
  return std::out_of_range("no type " + std::string(type) + " travels");
}

}  // namespace

bool GeneratedType::key_of(std::vector<std::uint8_t>& cdr, fast_dds::Handle& handle) const {
  // The generated code keeps its key buffer in the type object, which all threads of a participant share.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  fast_dds::Payload payload;
  payload.data = cdr.data();
  payload.length = static_cast<std::uint32_t>(cdr.size());
  payload.max_size = payload.length;
  const bool ok = fast_dds::key_of(*type_, payload, handle);
  payload.data = nullptr;  // not the payload's to free
  return ok;
}

GeneratedType generated_type(std::string_view type) {
  for (const idl::GeneratedStruct& one : idl::kStructs) {
    if (one.name == type) return GeneratedType(one.make());
  }
  throw unknown(type);
}

std::unique_ptr<fast_dds::TopicDataType> type_adapter(std::string_view type,
                                                      const std::shared_ptr<std::atomic<std::uint32_t>>& refused) {
  std::unique_ptr<fast_dds::TopicDataType> adapter;
  for_each(catalog::TravellingTypes{}, [&](auto tag) {
    using T = typename decltype(tag)::type;
    static_assert(stands_in_idl(catalog::WireType<T>::name), "idl/ has no struct with the name of this WireType");
    if (catalog::WireType<T>::name == type) adapter = std::make_unique<TypeAdapter<T>>(refused);
  });
  if (!adapter) throw unknown(type);
  return adapter;
}

}  // namespace inslab::dds
