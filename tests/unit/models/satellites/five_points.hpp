#pragma once

#include <cstdint>
#include <type_traits>

namespace inslab::test {

/// The derivative by time of what `value_at` gives at nanoseconds about an instant: five points a second apart, an
/// error of the fifth derivative over 30.
template <class Function>
auto five_point_derivative(Function value_at) {
  constexpr std::int64_t kStep_ns = 1'000'000'000;
  using Value = std::decay_t<decltype(value_at(0))>;
  const Value near = value_at(kStep_ns) - value_at(-kStep_ns);
  const Value far = value_at(2 * kStep_ns) - value_at(-2 * kStep_ns);
  return Value((8.0 * near - far) / 12.0);
}

}  // namespace inslab::test
