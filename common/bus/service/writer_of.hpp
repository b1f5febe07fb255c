#pragma once

#include <string>
#include <type_traits>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/block.hpp"
#include "inslab/data/samples/credit.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::service {

/// Whether services of several roles write samples of this type, so that each says itself whose it is.
template <class T>
inline constexpr bool names_its_writer =
    std::is_same_v<T, ServiceStatus> || std::is_same_v<T, ProfileAck> || std::is_same_v<T, Credit>;

/// Whose sample it says it is.
inline scenario::ServiceKey writer_of(const ServiceStatus& status) { return {status.service, status.sensor_number}; }
inline scenario::ServiceKey writer_of(const Credit& credit) { return {credit.consumer, credit.consumer_number}; }
inline scenario::ServiceKey writer_of(const ProfileAck& ack) {
  return {ack.service, ack.service == catalog::kTrajectoryServer ? 0u : ack.target.number};
}

namespace detail {
template <class T>
struct SampleOf {
  using type = T;
};
template <class T>
struct SampleOf<Block<T>> {
  using type = T;
};
}  // namespace detail

/// The service that alone writes a topic of ours with samples of this type, single or in blocks.
template <class T>
scenario::ServiceKey writer_of_topic(const std::string& topic) {
  using Sample = typename detail::SampleOf<T>::type;
  if constexpr (catalog::is_of_a_sensor<Sample>) {
    return {catalog::SourceOf<Sample>::service,
            static_cast<std::uint32_t>(std::stoul(topic.substr(topic.rfind('/') + 1)))};
  } else {
    return {catalog::kTrajectoryServer, 0u};
  }
}

/// Whether a service is one of the set's, and not a foreign app that speaks as they do.
inline bool is_of_the_set(const std::string& service) { return catalog::is_service(service); }

}  // namespace inslab::service
