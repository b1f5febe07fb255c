#pragma once

#include "inslab/data/wire/cdr.hpp"

/// What samples of the version before are like: without the fields that were appended since.
namespace inslab::test {

/// Counts the bytes of the fields that were there before.
struct CounterOfEarlierFields {
  wire::detail::SizeCounter counted;
  template <class Value>
  void operator()(const Field& field, Value& part) {
    if (field.is_appended || field.is_inserted) return;
    if constexpr (has_fields<std::remove_const_t<Value>>) {
      Value::fields(part, *this);
    } else if constexpr (is_list<std::remove_const_t<Value>>) {
      const auto count = static_cast<std::uint32_t>(part.size());
      counted(field, count);
      for (const auto& element : part) std::decay_t<decltype(element)>::fields(element, *this);
    } else {
      counted(field, part);
    }
  }
};

/// Whether so many bytes of `value` are a whole sample of the version before, with padding or without.
template <class T>
bool is_whole_in_the_version_before(const T& value, std::size_t size) {
  CounterOfEarlierFields counter;
  T::fields(value, counter);
  const std::size_t earlier = wire::kEncapsulationSize + counter.counted.size();
  return earlier < wire::encoded_size(value) && size >= earlier && size <= earlier + 3;
}

}  // namespace inslab::test
