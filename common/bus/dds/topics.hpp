#pragma once

#include <string>

#include "inslab/data/catalog/topic_names.hpp"
#include "inslab/data/catalog/wire_type.hpp"

/// The one table of topic, type and QoS. Rates are nominal; they size the histories.
namespace inslab::dds {

/// How a topic is delivered; dds/qos.cpp says what each means in Fast DDS settings.
enum class Delivery {
  Stream,   ///< reliable, volatile, keeps the last second: a stuck reader costs the others nothing
  Block,    ///< as a stream, in blocks; the sender's window, not the history, keeps it whole
  Latched,  ///< reliable, a late joiner gets the last value of each key
  Journal,  ///< reliable, a late joiner gets the whole history in order
  Answers,  ///< reliable, a late joiner gets the last thousands: a logger that was away must not miss one
  Request,  ///< reliable and volatile, from anybody: best-effort writers match too
};

template <class T>
struct Topic {
  using Type = T;
  std::string name;
  Delivery delivery;
  double nominal_rate_hz;
};

namespace topics {

namespace names = wire::topic_names;

// clang-format off
inline Topic<TruthState>    truth(double rate_hz = 200.0)                           { return {names::kTruth, Delivery::Stream, rate_hz}; }
inline Topic<ImuSample>     imu(std::uint32_t number, double rate_hz = 200.0)       { return {names::imu(number), Delivery::Stream, rate_hz}; }
inline Topic<ImuTruth>      imu_truth(std::uint32_t number, double rate_hz = 200.0) { return {names::imu_truth(number), Delivery::Stream, rate_hz}; }
inline Topic<GnssFix>       gnss(std::uint32_t number, double rate_hz = 10.0)       { return {names::gnss(number), Delivery::Stream, rate_hz}; }
inline Topic<NavSolution>   nav()            { return {names::kNav, Delivery::Request, 1000.0}; }

inline Topic<VehicleState>     vehicle_state(double rate_hz = 1000.0)      { return {names::kVehicleState, Delivery::Request, rate_hz}; }
inline Topic<UsedVehicleState> vehicle_state_used(double rate_hz = 1000.0) { return {names::kVehicleStateUsed, Delivery::Stream, rate_hz}; }
inline Topic<VehicleLink>      vehicle_link()                              { return {names::kVehicleLink, Delivery::Latched, 1.0}; }

inline Topic<Installation>  installation()   { return {names::kInstallation, Delivery::Latched, 1.0}; }
inline Topic<SimStatus>     sim_status()     { return {names::kSimStatus, Delivery::Latched, 10.0}; }
inline Topic<SimCommand>    sim_command()    { return {names::kSimCommand, Delivery::Request, 10.0}; }
inline Topic<ServiceStatus> service_status() { return {names::kServiceStatus, Delivery::Latched, 1.0}; }
inline Topic<TimeMark>      time_mark()      { return {names::kTimeMark, Delivery::Stream, 1.0}; }
inline Topic<ProfileAck>    profile_ack()    { return {names::kProfileAck, Delivery::Answers, 1000.0}; }

inline Topic<Credit>        credit()         { return {names::kCredit, Delivery::Latched, 1000.0}; }
/// The blocks of a stream, for lockstep.
template <class T>
Topic<Block<T>> block(const Topic<T>& stream) { return {names::block(stream.name), Delivery::Block, stream.nominal_rate_hz}; }

template <class Profile>
Topic<Profile> request() { return {names::request(Profile::kind), Delivery::Request, 100.0}; }
template <class Profile>
Topic<Profile> journal() { return {names::journal(Profile::kind), Delivery::Journal, 100.0}; }
// clang-format on

/// Calls `visit` with every topic of the table; those of a sensor with that number.
template <class Visit>
void for_each(std::uint32_t number, const Visit& visit) {
  const auto with_blocks = [&visit](const auto& stream) {
    visit(stream);
    visit(block(stream));
  };
  const auto of_kind = [&visit](const auto& requests, const auto& entries) {
    visit(requests);
    visit(entries);
  };
  with_blocks(truth());
  with_blocks(imu(number));
  with_blocks(imu_truth(number));
  with_blocks(gnss(number));
  with_blocks(nav());
  visit(vehicle_state());
  visit(vehicle_state_used());
  visit(vehicle_link());
  visit(installation());
  visit(sim_status());
  visit(sim_command());
  visit(service_status());
  visit(time_mark());
  visit(profile_ack());
  visit(credit());
  of_kind(request<ImuErrorProfile>(), journal<ImuErrorProfile>());
  of_kind(request<VibrationProfile>(), journal<VibrationProfile>());
  of_kind(request<InstallationProfile>(), journal<InstallationProfile>());
  of_kind(request<GnssErrorProfile>(), journal<GnssErrorProfile>());
  of_kind(request<FaultProfile>(), journal<FaultProfile>());
}

}  // namespace topics

}  // namespace inslab::dds
