#pragma once

#include <string>

#include "wire/wire_type.hpp"

/// The one table of topic, type and QoS. Rates are nominal; they size the histories.
namespace inslab::dds {

/// How a topic is delivered; dds/qos.cpp says what each means in Fast DDS settings.
enum class Delivery {
  Stream,    ///< reliable, volatile, keeps the last second: a stuck reader costs the others nothing
  Latched,   ///< reliable, a late joiner gets the last value of each key
  Journal,   ///< reliable, a late joiner gets the whole history in order
  Request,   ///< reliable and volatile, from anybody: best-effort writers match too
};

template <class T>
struct Topic {
  using Type = T;
  std::string name;
  Delivery delivery;
  double nominal_rate_hz;
};

namespace topics {

inline std::string numbered(const char* name, std::uint32_t number) {
  return name + std::to_string(number);
}

// clang-format off
inline Topic<TruthState>  truth(double rate_hz = 200.0)                             { return {"inslab/truth", Delivery::Stream, rate_hz}; }
inline Topic<ImuSample>   imu(std::uint32_t number, double rate_hz = 200.0)         { return {numbered("inslab/imu/", number), Delivery::Stream, rate_hz}; }
inline Topic<ImuTruth>    imu_truth(std::uint32_t number, double rate_hz = 200.0)   { return {numbered("inslab/imu_truth/", number), Delivery::Stream, rate_hz}; }
inline Topic<GnssFix>     gnss(std::uint32_t number, double rate_hz = 10.0)         { return {numbered("inslab/gnss/", number), Delivery::Stream, rate_hz}; }
inline Topic<NavSolution> nav()                                                     { return {"inslab/nav", Delivery::Request, 1000.0}; }

inline Topic<Installation>  installation()   { return {"inslab/installation", Delivery::Latched, 1.0}; }
inline Topic<SimStatus>     sim_status()     { return {"inslab/sim/status", Delivery::Latched, 10.0}; }
inline Topic<SimCommand>    sim_command()    { return {"inslab/sim/command", Delivery::Request, 10.0}; }
inline Topic<ServiceStatus> service_status() { return {"inslab/service_status", Delivery::Latched, 1.0}; }
inline Topic<TimeMark>      time_mark()      { return {"inslab/time_mark", Delivery::Stream, 1.0}; }
inline Topic<ProfileAck>    profile_ack()    { return {"inslab/profile_ack", Delivery::Stream, 1000.0}; }
// clang-format on

/// "imu_error", "vibration", ...: the last word of the request and journal topics of a profile type.
template <class Profile>
std::string profile_word() {
  return std::string(enum_name(Profile::kind));
}
template <class Profile>
Topic<Profile> request() {
  return {"inslab/profile/" + profile_word<Profile>(), Delivery::Request, 100.0};
}
template <class Profile>
Topic<Profile> journal() {
  return {"inslab/journal/" + profile_word<Profile>(), Delivery::Journal, 100.0};
}

}  // namespace topics

}  // namespace inslab::dds
