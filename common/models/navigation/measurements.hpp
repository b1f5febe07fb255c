#pragma once

#include <tuple>
#include <type_traits>
#include <variant>

#include "inslab/data/samples/measured.hpp"
#include "inslab/models/navigation/baseline_direction.hpp"
#include "inslab/models/navigation/gnss_position.hpp"
#include "inslab/models/navigation/gnss_velocity.hpp"
#include "inslab/models/navigation/magnetic_vector.hpp"
#include "inslab/models/navigation/pressure_altitude.hpp"
#include "inslab/models/navigation/rolling_without_slide.hpp"
#include "inslab/models/navigation/wheel_speed.hpp"
#include "inslab/models/navigation/zero_velocity_update.hpp"

namespace inslab::navigation {

/// Every kind of measurement that the filter takes: the one list. A kind is a header with a struct of
///
///   Sample               what is observed: its header says when it is valid, available_sim_time_ns when it is there (a
///                        sample that does not say is there at once)
///   name                 in results
///   usable(sample)       whether its numbers can be used at all
///   add_to(measurements, sample, situation, parameters)   adds those that it makes of a sample: none, one or several
///
/// Kinds of one sample share its time: their gates are judged by the state before any of them, in this order.
using MeasurementKinds = std::tuple<GnssPosition, GnssVelocity, ZeroVelocityUpdate, MagneticVector, PressureAltitude,
                                    WheelSpeed, RollingWithoutSlide, BaselineDirection>;

namespace detail {
template <class Variant, class Kinds>
struct SamplesOf;
template <class... Samples>
struct SamplesOf<std::variant<Samples...>, std::tuple<>> {
  using Type = std::variant<Samples...>;
};
template <class... Samples, class Kind, class... Kinds>
struct SamplesOf<std::variant<Samples...>, std::tuple<Kind, Kinds...>> {
  static constexpr bool is_known = (std::is_same_v<Samples, typename Kind::Sample> || ...);
  using More = std::conditional_t<is_known, std::variant<Samples...>, std::variant<Samples..., typename Kind::Sample>>;
  using Type = typename SamplesOf<More, std::tuple<Kinds...>>::Type;
};

/// Calls `use` with each kind that is made of `Sample`.
template <class Sample, class Use, class... Kinds>
void for_each_kind_of(const Use& use, std::tuple<Kinds...>*) {
  const auto when = [&](auto* kind) {
    if constexpr (std::is_same_v<typename std::remove_pointer_t<decltype(kind)>::Sample, Sample>) use(kind);
  };
  (when(static_cast<Kinds*>(nullptr)), ...);
}
template <class Sample, class Use>
void for_each_kind_of(const Use& use) {
  for_each_kind_of<Sample>(use, static_cast<MeasurementKinds*>(nullptr));
}
}  // namespace detail

/// What is observed: a sample of any kind of measurement.
using Observation = typename detail::SamplesOf<std::variant<>, MeasurementKinds>::Type;

inline std::int64_t valid_at_ns(const Observation& observation) {
  return std::visit([](const auto& sample) { return sample.header.sim_time_ns; }, observation);
}

inline std::int64_t available_at_ns(const Observation& observation) {
  return std::visit([](const auto& sample) { return samples::available_at_ns(sample); }, observation);
}

/// Whether every kind that is made of it can use its numbers.
inline bool usable(const Observation& observation) {
  return std::visit(
      [](const auto& sample) {
        bool all = true;
        detail::for_each_kind_of<std::decay_t<decltype(sample)>>(
            [&](auto* kind) { all = all && std::remove_pointer_t<decltype(kind)>::usable(sample); });
        return all;
      },
      observation);
}

inline std::vector<Measurement> measurements_of(const Observation& observation, const Situation& at,
                                                const NavigationParameters& parameters) {
  std::vector<Measurement> measurements;
  std::visit(
      [&](const auto& sample) {
        detail::for_each_kind_of<std::decay_t<decltype(sample)>>(
            [&](auto* kind) { std::remove_pointer_t<decltype(kind)>::add_to(measurements, sample, at, parameters); });
      },
      observation);
  return measurements;
}

}  // namespace inslab::navigation
