#pragma once

#include <string_view>
#include <vector>

#include "inslab/data/catalog/sensor_kinds.hpp"

/// The processes of a set, and who they are to DDS Security.
namespace inslab::catalog {

inline constexpr const char* kTrajectoryServer = "inslab-trajectory-server";
inline constexpr const char* kTruthLogger = "inslab-truth-logger";
inline constexpr const char* kReferenceNav = "inslab-reference-nav";

/// Who may read or write a topic: several roles at once. Who is not one of our services has the identity of that name.
struct Roles {
  unsigned bits;

  friend constexpr Roles operator|(Roles a, Roles b) { return {a.bits | b.bits}; }
  constexpr bool has(Roles role) const { return (bits & role.bits) != 0; }
};
namespace roles {
inline constexpr Roles kNobody{0};
inline constexpr Roles kServer{1};
inline constexpr Roles kSensors{2};  ///< the services of all sensors
inline constexpr Roles kLogger{4};
inline constexpr Roles kOperator{8};
inline constexpr Roles kNavApp{16};
inline constexpr Roles kVehicle{32};
}  // namespace roles

/// The logger writes down everything, and the operator looks at everything.
inline constexpr Roles kReadersOfAll = roles::kLogger | roles::kOperator;

/// The identity of those who are no service of ours.
inline constexpr const char* kOperatorIdentity = "operator";
inline constexpr const char* kNavAppIdentity = "nav-app";
inline constexpr const char* kVehicleIdentity = "vehicle-simulator";

/// One program of a set.
struct Service {
  std::string_view name;
  std::string_view sensor;  ///< the kind of sensor of which there is one for each; empty: there is one of it
};

/// Whether a service makes the data of a sensor.
inline bool is_of_a_sensor_kind(std::string_view service) {
  bool is_one = false;
  for_each(SensorKinds{}, [&](auto kind) { is_one = is_one || service == decltype(kind)::type::service; });
  return is_one;
}

/// All of them.
inline std::vector<Service> services() {
  std::vector<Service> all{{kTrajectoryServer, ""}};
  for_each(SensorKinds{}, [&all](auto kind) {
    all.push_back({decltype(kind)::type::service, decltype(kind)::type::name});
  });
  all.push_back({kTruthLogger, ""});
  all.push_back({kReferenceNav, ""});
  return all;
}

/// Whether a service is one of a set's.
inline bool is_service(std::string_view name) {
  return name == kTrajectoryServer || name == kTruthLogger || name == kReferenceNav || is_of_a_sensor_kind(name);
}

/// The identity under which a program joins a secured set: our services have one each, but that the reference
/// navigation app is an app under test; all commands are the operator.
inline std::string_view security_identity(std::string_view program) {
  if (program == kReferenceNav) return kNavAppIdentity;
  return is_service(program) ? program : kOperatorIdentity;
}

}  // namespace inslab::catalog
