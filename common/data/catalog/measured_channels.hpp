#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "inslab/data/catalog/sensor_kinds.hpp"
#include "inslab/data/samples/measured.hpp"

namespace inslab::catalog {

/// A measured value of a kind of sensor, on which a fault can act alone.
struct MeasuredChannel {
  std::string_view name;  ///< the field's, with its unit
  bool has_axes = false;  ///< three numbers, not one
  double least_shown = 0.0;
  double most_shown = 0.0;
};

/// Those of a kind: the fields of its first stream that are declared as measured.
inline std::vector<MeasuredChannel> measured_channels(SensorKind sensor) {
  std::vector<MeasuredChannel> channels;
  with_sensor(sensor, [&channels](auto kind) {
    FirstSampleOf<typename decltype(kind)::type> sample;
    for_each_measured(sample, [&channels](const Field& field, auto& value) {
      constexpr bool has_axes = std::is_same_v<std::decay_t<decltype(value)>, Vector3>;
      channels.push_back({field.name, has_axes, field.least_shown, field.most_shown});
    });
  });
  return channels;
}

/// "pressure_pa, temperature_deg_c".
inline std::string words_of(const std::vector<MeasuredChannel>& channels) {
  std::string words;
  for (const MeasuredChannel& channel : channels) words += (words.empty() ? "" : ", ") + std::string(channel.name);
  return words;
}

}  // namespace inslab::catalog
