#include "inslab/bus/client/set_listener.hpp"

#include <algorithm>

#include "inslab/bus/service/service.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::client {

namespace {

streams::Identity of_any_set(const service::NetworkOptions& network) {
  streams::Identity own;
  own.service = "inslab-status";
  own.unit = network.unit;
  return own;
}

}  // namespace

SetListener::SetListener(const service::NetworkOptions& network)
    : participant_(service::participant_options(network, "inslab-status")),
      writers_(participant_.peers(), participant_.key(), of_any_set(network)),
      services_reader_(participant_, dds::topics::service_status(),
                       [this](const ServiceStatus& status, const dds::SampleOrigin&) {
                         const std::lock_guard<std::mutex> lock(mutex_);
                         Heard& heard = services_[{status.service, status.sensor_number}];
                         heard = {{status, std::move(heard.heartbeats.last)}, host::monotonic_now()};
                       }),
      status_reader_(participant_, dds::topics::sim_status(),
                     writers_.only(dds::topics::sim_status(),
                                   [this](const SimStatus& status, const dds::SampleOrigin&) {
                                     const std::lock_guard<std::mutex> lock(mutex_);
                                     run_ = status;
                                   })),
      vehicle_reader_(
          participant_, dds::topics::vehicle_link(),
          writers_.only(dds::topics::vehicle_link(), [this](const VehicleLink& link, const dds::SampleOrigin&) {
            const std::lock_guard<std::mutex> lock(mutex_);
            vehicle_ = link;
          })) {}

std::vector<Heartbeats> SetListener::living(time::Nanoseconds since) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Heartbeats> services;
  for (const auto& [key, heard] : services_) {
    if (heard.at >= since) services.push_back(heard.heartbeats);
  }
  return services;
}

std::optional<VehicleLink> SetListener::vehicle() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return vehicle_;
}

std::optional<SimStatus> SetListener::run() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return run_;
}

std::vector<scenario::ServiceKey> missing_of(const std::vector<scenario::ServiceKey>& expected,
                                             const std::vector<Heartbeats>& services) {
  std::vector<scenario::ServiceKey> missing;
  for (const scenario::ServiceKey& key : expected) {
    const bool lives = std::any_of(services.begin(), services.end(), [&key](const Heartbeats& service) {
      return scenario::ServiceKey{service.last.service, service.last.sensor_number} == key;
    });
    if (!lives) missing.push_back(key);
  }
  return missing;
}

std::vector<scenario::ServiceKey> expected_services(const std::string& scenario_file) {
  std::vector<scenario::ServiceKey> expected{{catalog::kTrajectoryServer, 0u}};
  if (scenario_file.empty()) {
    for_each(catalog::SensorKinds{}, [&expected](auto kind) {
      using Kind = typename decltype(kind)::type;
      if (Kind::in_every_set) expected.emplace_back(Kind::service, 0u);
    });
    expected.emplace_back(catalog::kTruthLogger, 0u);
  } else {
    for (const scenario::ServiceKey& key : scenario::required_services(scenario::load(scenario_file)))
      expected.push_back(key);
  }
  return expected;
}

}  // namespace inslab::client
