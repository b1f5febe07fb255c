// What a foreign writer may send: every type's decoder takes any bytes without harm, and what it accepts is encoded to
// bytes that decode to the same again.
#include <cstdlib>
#include <vector>

#include "inslab/data/catalog/wire_type.hpp"
#include "inslab/data/wire/cdr.hpp"

namespace {

using namespace inslab;

template <class T>
void decode_twice(const std::uint8_t* data, std::size_t size) {
  T value;
  if (!wire::decode(data, size, value)) return;
  std::vector<std::uint8_t> once;
  wire::encode(value, once);
  T again;
  if (!wire::decode(once.data(), once.size(), again)) std::abort();
  std::vector<std::uint8_t> twice;
  wire::encode(again, twice);
  if (once != twice) std::abort();
}

template <class... Types>
struct Decoders {
  static void choose(std::size_t index, const std::uint8_t* data, std::size_t size) {
    using Decode = void (*)(const std::uint8_t*, std::size_t);
    constexpr Decode decoders[] = {&decode_twice<Types>...};
    decoders[index % (sizeof(decoders) / sizeof(decoders[0]))](data, size);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  Applied<Decoders, catalog::TravellingTypes>::choose(data[0], data + 1, size - 1);
  return 0;
}
