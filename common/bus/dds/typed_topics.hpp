#pragma once

#include <string>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/catalog/wire_type.hpp"

/// The topics of the catalogue as readers and writers take them. Rates are nominal; they size the histories.
namespace inslab::dds {

using catalog::Delivery;

template <class T>
struct Topic {
  using Type = T;
  std::string name;
  Delivery delivery;
  double nominal_rate_hz;
  bool is_kept = false;  ///< by its writer, for a reader that was away
};

namespace topics {

template <class T, bool has_blocks>
Topic<T> of(const catalog::Topic<T, has_blocks>& topic, double rate_hz) {
  return {topic.name, topic.delivery, rate_hz};
}
template <class T, bool has_blocks>
Topic<T> of(const catalog::Topic<T, has_blocks>& topic) {
  return of(topic, topic.nominal_rate_hz);
}

// clang-format off
inline Topic<TruthState>    truth()               { return of(catalog::kTruth); }
inline Topic<TruthState>    truth(double rate_hz) { return of(catalog::kTruth, rate_hz); }
inline Topic<NavSolution>   nav()                 { return of(catalog::kNav); }

inline Topic<VehicleState>     vehicle_state()                    { return of(catalog::kVehicleState); }
inline Topic<VehicleState>     vehicle_state(double rate_hz)      { return of(catalog::kVehicleState, rate_hz); }
inline Topic<UsedVehicleState> vehicle_state_used()               { return of(catalog::kVehicleStateUsed); }
inline Topic<UsedVehicleState> vehicle_state_used(double rate_hz) { return of(catalog::kVehicleStateUsed, rate_hz); }
inline Topic<VehicleLink>      vehicle_link()                     { return of(catalog::kVehicleLink); }

inline Topic<Installation>  installation()   { return of(catalog::kInstallation); }
inline Topic<SimStatus>     sim_status()     { return of(catalog::kSimStatus); }
inline Topic<SimCommand>    sim_command()    { return of(catalog::kSimCommand); }
inline Topic<ServiceStatus> service_status() { return of(catalog::kServiceStatus); }
inline Topic<TimeMark>      time_mark()      { return of(catalog::kTimeMark); }
inline Topic<ProfileAck>    profile_ack()    { return of(catalog::kProfileAck); }
inline Topic<Credit>        credit()         { return of(catalog::kCredit); }

/// The stream of sensor `number` with such samples.
template <class Sample>
Topic<Sample> stream(std::uint32_t number, double rate_hz = catalog::kStream<Sample>.nominal_rate_hz) { return {catalog::stream_topic<Sample>(number), Delivery::Stream, rate_hz}; }
/// The blocks of a stream, for lockstep.
template <class T>
Topic<Block<T>> block(const Topic<T>& stream) { return {catalog::block_topic(stream.name), Delivery::Block, stream.nominal_rate_hz}; }

/// The same topic from a writer that keeps the newest of what it wrote, or to a reader that was away and wants them.
template <class T>
Topic<T> kept(const Topic<T>& topic) { return {topic.name, topic.delivery, topic.nominal_rate_hz, true}; }

template <class Profile>
Topic<Profile> request() { return {catalog::request_topic(Profile::kind), Delivery::Request, 100.0}; }
template <class Profile>
Topic<Profile> journal() { return {catalog::journal_topic(Profile::kind), Delivery::Journal, 100.0}; }
// clang-format on

/// Calls `visit` with every topic there is; those of a sensor with that number. The blocks of a stream come after it.
template <class Visit>
void for_each(std::uint32_t number, const Visit& visit) {
  for_each_of(catalog::kTopics, [&visit](const auto& topic) {
    visit(of(topic));
    if constexpr (std::decay_t<decltype(topic)>::has_blocks) visit(block(of(topic)));
  });
  inslab::for_each(catalog::SensorSamples{}, [&visit, number](auto sample) {
    const auto one = stream<typename decltype(sample)::type>(number);
    visit(one);
    visit(block(one));
  });
  inslab::for_each(catalog::ProfileKinds{}, [&visit](auto profile) {
    visit(request<typename decltype(profile)::type>());
    visit(journal<typename decltype(profile)::type>());
  });
}

}  // namespace topics

}  // namespace inslab::dds
