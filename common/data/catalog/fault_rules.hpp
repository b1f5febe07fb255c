#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "inslab/data/catalog/measured_channels.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/fields/violation.hpp"

/// Rules of faults: whether a sensor of the kind can have them.
namespace inslab::catalog {

namespace detail {

/// Finds the first fault that another kind of sensor has than the one it is for.
class FaultFits {
 public:
  explicit FaultFits(SensorKind target) : target_(enum_name(target)) {}
  std::optional<Violation> found;

  template <class T>
  void operator()(const Field& field, const T& value) {
    if (found || field.sensor_kind.empty() || field.sensor_kind == target_ || is_off(value)) return;
    found = Violation{Rule::FaultFitsSensor, std::string(field.name),
                      "is given; this is a fault of a sensor of kind " + std::string(field.sensor_kind)};
  }

 private:
  static bool is_off(const Vector3& value) { return value.isZero(0.0); }
  static bool is_off(double value) { return value == 0.0; }
  static bool is_off(bool value) { return !value; }
  static bool is_off(AxisFault value) { return value == AxisFault::None; }
  static bool is_off(FixType value) { return value == FixType::None; }
  template <class T>
  static bool is_off(const T&) {  // what every kind has
    return true;
  }

  std::string_view target_;
};

inline std::optional<Violation> one_number_violation(const std::string& path, const Vector3& value) {
  if (value == Vector3::Constant(value.x())) return std::nullopt;
  return Violation{Rule::FaultFitsSensor, path, "differs by axis; the channel is one number"};
}

inline std::optional<Violation> channels_violation(const FaultProfile& profile) {
  const std::vector<MeasuredChannel> known = measured_channels(profile.target.kind);
  for (std::size_t i = 0; i < profile.common.channels.size(); ++i) {
    const ChannelFault& fault = profile.common.channels[i];
    const std::string path = "channels[" + std::to_string(i) + "].";
    const auto channel =
        std::find_if(known.begin(), known.end(), [&](const auto& c) { return c.name == fault.channel; });
    if (channel == known.end()) {
      return Violation{Rule::FaultFitsSensor, path + "channel",
                       "is '" + fault.channel + "'; a sensor of kind " + std::string(enum_name(profile.target.kind)) +
                           " measures " + words_of(known)};
    }
    if (channel->has_axes) continue;
    if (auto broken = one_number_violation(path + "jump", fault.jump)) return broken;
    if (auto broken = one_number_violation(path + "ramp_per_s", fault.ramp_per_s)) return broken;
    if (auto broken = one_number_violation(path + "noise_sigma", fault.noise_sigma)) return broken;
  }
  return std::nullopt;
}

}  // namespace detail

/// The first rule that a fault breaks.
inline std::optional<Violation> fault_violation(const FaultProfile& profile) {
  detail::FaultFits fits(profile.target.kind);
  FaultProfile::fields(profile, fits);
  if (fits.found) return fits.found;
  if (auto broken = detail::channels_violation(profile)) return broken;
  if (profile.common.intermittent_period_s == 0.0 || !profile.common.are_none()) return std::nullopt;
  return Violation{Rule::FaultComesAndGoes, "intermittent_period_s",
                   "is " + number_text(profile.common.intermittent_period_s) +
                       " without a fault that comes and goes; of a loose contact that is off"};
}

}  // namespace inslab::catalog
