#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "inslab/data/requests/run_control.hpp"
#include "inslab/data/samples/service_status.hpp"
#include "inslab/data/samples/vehicle_state.hpp"

namespace inslab::client {

/// The last two heartbeats of a service.
struct Heartbeats {
  ServiceStatus last;
  ServiceStatus before;  ///< without any stream when there was none
};

// The tables of `inslab status`. No line is wider than a terminal of 80 columns.

/// Where the run is, and how the states of a live vehicle come; `where` names the place in which no server was heard.
std::string run_table(const std::optional<SimStatus>& run, const std::optional<VehicleLink>& vehicle,
                      const std::string& where);

/// A line for each service with what it says below, then those that are missing: names and sensor numbers.
std::string service_table(const std::vector<Heartbeats>& services,
                          const std::vector<std::pair<std::string, std::uint32_t>>& missing);

/// What each service counts on its streams; the rate is that between its last two heartbeats.
std::string stream_table(const std::vector<Heartbeats>& services);

}  // namespace inslab::client
