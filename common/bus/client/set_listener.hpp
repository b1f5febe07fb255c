#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "inslab/bus/client/status_table.hpp"
#include "inslab/bus/dds/reader.hpp"
#include "inslab/bus/service/service_options.hpp"
#include "inslab/bus/service/writers.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/vehicle_state.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/scenario/service_names.hpp"

namespace inslab::client {

/// Hears how the services of the set in a unit are, and how its run goes.
class SetListener {
 public:
  explicit SetListener(const service::NetworkOptions& network);

  /// The last two heartbeats of those heard after `since`, CLOCK_MONOTONIC. One that was not heard for as long as two
  /// heartbeats take is missing, whatever DDS thinks of its lease.
  std::vector<Heartbeats> living(time::Nanoseconds since) const;
  std::optional<VehicleLink> vehicle() const;
  std::optional<SimStatus> run() const;

 private:
  struct Heard {
    Heartbeats heartbeats;
    time::Nanoseconds at{0};  ///< CLOCK_MONOTONIC
  };

  dds::Participant participant_;
  service::Writers writers_;
  mutable std::mutex mutex_;
  std::map<scenario::ServiceKey, Heard> services_;
  std::optional<SimStatus> run_;
  std::optional<VehicleLink> vehicle_;
  dds::Reader<ServiceStatus> services_reader_;
  dds::Reader<SimStatus> status_reader_;
  dds::Reader<VehicleLink> vehicle_reader_;
};

/// Those of the expected services that are not among the living.
std::vector<scenario::ServiceKey> missing_of(const std::vector<scenario::ServiceKey>& expected,
                                             const std::vector<Heartbeats>& services);

/// The services of a scenario's set; of no scenario: one of each. Throws json::Error, files::ReadError.
std::vector<scenario::ServiceKey> expected_services(const std::string& scenario_file);

}  // namespace inslab::client
