#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "inslab/data/samples/stream_header.hpp"

namespace inslab {
inline namespace samples {

/// Calls `use(field, value)` with each measured field of a sample (Field::measured): a number or three.
template <class Sample, class Use>
void for_each_measured(Sample& sample, const Use& use) {
  const auto visit = [&use](const Field& field, auto& value) {
    using Value = std::remove_const_t<std::remove_reference_t<decltype(value)>>;
    if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, Vector3>) {
      if (field.is_measured) use(field, value);
    }
  };
  std::remove_const_t<Sample>::fields(sample, visit);
}

namespace detail {
template <class Sample, class = void>
inline constexpr bool has_what_follows = false;
template <class Sample>
inline constexpr bool
    has_what_follows<Sample, std::void_t<decltype(std::declval<Sample&>().settle(std::declval<const Sample&>()))>> =
        true;

template <class Sample, class = void>
inline constexpr bool says_when_available = false;
template <class Sample>
inline constexpr bool says_when_available<Sample, std::void_t<decltype(Sample::available_sim_time_ns)>> = true;
}  // namespace detail

/// Measured fields of `sample`, which was `before`, have been changed: so are the fields that follow from them.
template <class Sample>
void settle(Sample& sample, const Sample& before) {
  if constexpr (detail::has_what_follows<Sample>) sample.settle(before);
}

/// When an app has the sample: never before the time of validity; a sample that does not say is there at once.
template <class Sample>
std::int64_t available_at_ns(const Sample& sample) {
  if constexpr (detail::says_when_available<Sample>) {
    // Earlier logs have samples that did not say yet.
    if (sample.available_sim_time_ns > sample.header.sim_time_ns) return sample.available_sim_time_ns;
  }
  return sample.header.sim_time_ns;
}

template <class Sample>
void make_available_at(Sample& sample, std::int64_t sim_time_ns) {
  if constexpr (detail::says_when_available<Sample>) sample.available_sim_time_ns = sim_time_ns;
}

}  // namespace samples
}  // namespace inslab
