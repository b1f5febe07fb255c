#pragma once

#include <string>
#include <tuple>

#include "inslab/data/catalog/services.hpp"
#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/block.hpp"
#include "inslab/data/samples/credit.hpp"
#include "inslab/data/samples/nav_solution.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/truth_state.hpp"
#include "inslab/data/samples/vehicle_state.hpp"

/// The topics, on the bus and in the logs: names, types, how they are delivered, who may write and read them. Those of
/// the sensors and of the profiles follow from their kinds.
namespace inslab::catalog {

/// How a topic is delivered; dds/qos.cpp says what each means in Fast DDS settings.
enum class Delivery {
  Stream,   ///< reliable, volatile, keeps the last second: a stuck reader costs the others nothing
  Block,    ///< as a stream, in blocks; the sender's window, not the history, keeps it whole
  Latched,  ///< reliable, a late joiner gets the last value of each key
  Journal,  ///< reliable, a late joiner gets the whole history in order
  Answers,  ///< reliable, a late joiner gets the last thousands: a logger that was away must not miss one
  Request,  ///< reliable and volatile, from anybody: best-effort writers match too
};

/// A topic of which there is one. In lockstep those with blocks come on a topic of blocks too.
template <class T, bool has_blocks_too = false>
struct Topic {
  using Type = T;
  static constexpr bool has_blocks = has_blocks_too;

  const char* name;
  Delivery delivery;
  double nominal_rate_hz;  ///< sizes the histories
  Roles writers;
  Roles readers;  ///< besides those of all
  Roles readers_of_blocks = roles::kNobody;
};

namespace detail {
inline constexpr Roles kAll = roles::kServer | roles::kSensors | roles::kLogger | roles::kNavApp;
}

// clang-format off
inline constexpr Topic<TruthState, true>  kTruth{"inslab/truth", Delivery::Stream, 200.0, roles::kServer, roles::kSensors, roles::kSensors};
inline constexpr Topic<NavSolution, true> kNav{"inslab/nav", Delivery::Request, 1000.0, roles::kNavApp, roles::kSensors};
inline constexpr Topic<VehicleState>      kVehicleState{"inslab/vehicle_state", Delivery::Request, 1000.0, roles::kVehicle, roles::kServer};
inline constexpr Topic<UsedVehicleState>  kVehicleStateUsed{"inslab/vehicle_state_used", Delivery::Stream, 1000.0, roles::kServer, roles::kNobody};
inline constexpr Topic<VehicleLink>       kVehicleLink{"inslab/vehicle_link", Delivery::Latched, 1.0, roles::kServer, roles::kNobody};
inline constexpr Topic<Installation>      kInstallation{"inslab/installation", Delivery::Latched, 1.0, roles::kServer, roles::kNavApp};
inline constexpr Topic<SimStatus>         kSimStatus{"inslab/sim/status", Delivery::Latched, 10.0, roles::kServer, roles::kServer | roles::kSensors | roles::kNavApp | roles::kVehicle};
inline constexpr Topic<SimCommand>        kSimCommand{"inslab/sim/command", Delivery::Request, 10.0, roles::kOperator, roles::kServer};
inline constexpr Topic<ServiceStatus>     kServiceStatus{"inslab/service_status", Delivery::Latched, 1.0, detail::kAll, roles::kServer | roles::kNavApp};
inline constexpr Topic<TimeMark>          kTimeMark{"inslab/time_mark", Delivery::Stream, 1.0, roles::kServer, roles::kVehicle};
inline constexpr Topic<ProfileAck>        kProfileAck{"inslab/profile_ack", Delivery::Answers, 1000.0, roles::kServer | roles::kSensors, roles::kNobody};
inline constexpr Topic<Credit>            kCredit{"inslab/credit", Delivery::Latched, 1000.0, detail::kAll, roles::kServer | roles::kSensors | roles::kNavApp};
// clang-format on

inline constexpr std::tuple kTopics{kTruth,         kNav,          kVehicleState, kVehicleStateUsed,
                                    kVehicleLink,   kInstallation, kSimStatus,    kSimCommand,
                                    kServiceStatus, kTimeMark,     kProfileAck,   kCredit};

/// Every topic of ours begins so.
inline constexpr std::string_view kRoot = "inslab/";

/// The topic of a sensor's stream, by its samples.
template <class Sample>
std::string stream_topic(std::uint32_t number) {
  return std::string(kRoot) + kStream<Sample>.name + "/" + std::to_string(number);
}

/// Where lockstep sends a stream in blocks: inslab/imu/0 becomes inslab/block/imu/0.
inline std::string block_topic(std::string_view stream) {
  return std::string(kRoot) + "block/" + std::string(stream.substr(kRoot.size()));
}

/// Where profiles of a kind are asked for, and what the journal made of it. The operator writes the one, the trajectory
/// server the other.
inline constexpr const char* kRequests = "inslab/profile/";
inline constexpr const char* kJournal = "inslab/journal/";
inline std::string request_topic(ProfileKind kind) { return kRequests + std::string(enum_name(kind)); }
inline std::string journal_topic(ProfileKind kind) { return kJournal + std::string(enum_name(kind)); }

}  // namespace inslab::catalog
