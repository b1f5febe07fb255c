#pragma once

#include <string>
#include <variant>

#include "inslab/data/catalog/profile_kinds.hpp"

namespace inslab::catalog {

/// One profile of any kind: a request, or an entry of the journal.
using AnyProfile = Applied<std::variant, ProfileKinds>;

inline ProfileKind kind_of(const AnyProfile& profile) {
  return std::visit([](const auto& p) { return p.kind; }, profile);
}
inline const SensorAddress& target_of(const AnyProfile& profile) {
  return std::visit([](const auto& p) -> const SensorAddress& { return p.target; }, profile);
}
inline const ProfileRequest& request_of(const AnyProfile& profile) {
  return std::visit([](const auto& p) -> const ProfileRequest& { return p.request; }, profile);
}
inline ProfileRequest& request_of(AnyProfile& profile) {
  return std::visit([](auto& p) -> ProfileRequest& { return p.request; }, profile);
}
inline const std::string& name_of(const AnyProfile& profile) {
  return std::visit([](const auto& p) -> const std::string& { return p.name; }, profile);
}

/// "imu0", "gnss1": a sensor in names of streams, messages and metadata.
inline std::string sensor_name(const SensorAddress& sensor) {
  return std::string(enum_name(sensor.kind)) + std::to_string(sensor.number);
}

}  // namespace inslab::catalog
