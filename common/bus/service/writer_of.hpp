#pragma once

#include <string>
#include <type_traits>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/block.hpp"
#include "inslab/data/samples/credit.hpp"
#include "inslab/data/samples/gnss_fix.hpp"
#include "inslab/data/samples/imu_sample.hpp"
#include "inslab/data/samples/imu_truth.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::app {

/// Whether services of several roles write samples of this type, so that each says itself whose it is.
template <class T>
inline constexpr bool names_its_writer =
    std::is_same_v<T, ServiceStatus> || std::is_same_v<T, ProfileAck> || std::is_same_v<T, Credit>;

/// Whose sample it says it is.
inline ServiceKey writer_of(const ServiceStatus& status) { return {status.service, status.sensor_number}; }
inline ServiceKey writer_of(const Credit& credit) { return {credit.consumer, credit.consumer_number}; }
inline ServiceKey writer_of(const ProfileAck& ack) {
  return {ack.service, ack.service == kTrajectoryServer ? 0u : ack.target.number};
}

/// The service that alone writes a topic of ours with samples of this type.
template <class T>
ServiceKey writer_of_topic(const std::string& topic) {
  const auto number = [&topic] { return static_cast<std::uint32_t>(std::stoul(topic.substr(topic.rfind('/') + 1))); };
  constexpr bool of_imu = std::is_same_v<T, ImuSample> || std::is_same_v<T, ImuTruth> ||
                          std::is_same_v<T, Block<ImuSample>> || std::is_same_v<T, Block<ImuTruth>>;
  if constexpr (of_imu) {
    return {kImuInjector, number()};
  } else if constexpr (std::is_same_v<T, GnssFix> || std::is_same_v<T, Block<GnssFix>>) {
    return {kGnssEmulator, number()};
  } else {
    return {kTrajectoryServer, 0u};
  }
}

/// Whether a service is one of the set's, and not a foreign app that speaks as they do.
inline bool is_of_the_set(const std::string& service) {
  return service == kTrajectoryServer || service == kImuInjector || service == kGnssEmulator ||
         service == kTruthLogger || service == kReferenceNav;
}

}  // namespace inslab::app
