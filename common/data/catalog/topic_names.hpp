#pragma once

#include <string>

#include "inslab/data/requests/profile_request.hpp"

/// The names of the topics, on the bus and in the logs.
namespace inslab::wire::topic_names {

inline constexpr const char* kTruth = "inslab/truth";
inline constexpr const char* kNav = "inslab/nav";
inline constexpr const char* kVehicleState = "inslab/vehicle_state";
inline constexpr const char* kVehicleStateUsed = "inslab/vehicle_state_used";
inline constexpr const char* kVehicleLink = "inslab/vehicle_link";
inline constexpr const char* kInstallation = "inslab/installation";
inline constexpr const char* kSimStatus = "inslab/sim/status";
inline constexpr const char* kSimCommand = "inslab/sim/command";
inline constexpr const char* kServiceStatus = "inslab/service_status";
inline constexpr const char* kTimeMark = "inslab/time_mark";
inline constexpr const char* kProfileAck = "inslab/profile_ack";
inline constexpr const char* kCredit = "inslab/credit";

inline std::string imu(std::uint32_t number) { return "inslab/imu/" + std::to_string(number); }
inline std::string imu_truth(std::uint32_t number) { return "inslab/imu_truth/" + std::to_string(number); }
inline std::string gnss(std::uint32_t number) { return "inslab/gnss/" + std::to_string(number); }
/// Where lockstep sends a stream in blocks: inslab/imu/0 becomes inslab/block/imu/0.
inline std::string block(const std::string& stream) { return "inslab/block/" + stream.substr(7); }
inline std::string request(ProfileKind kind) { return "inslab/profile/" + std::string(enum_name(kind)); }
inline std::string journal(ProfileKind kind) { return "inslab/journal/" + std::string(enum_name(kind)); }

}  // namespace inslab::wire::topic_names
