#pragma once

#include <string>
#include <utility>
#include <vector>

#include "inslab/data/catalog/services.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::scenario {

using ServiceKey = std::pair<std::string, std::uint32_t>;  // service, sensor number

/// The app under test, in credits: it is not ours and need not know of them.
inline constexpr const char* kNavApp = "navigation app";
/// What the message of a service begins with that was told to stop in mid-run: its going is no fault of the run's.
inline constexpr const char* kEndedBySignal = "ended by a signal in mid-run";

/// How the message of a service begins that is ready but for the app: the service is not what is missing.
inline constexpr const char* kWaitsForApp = "waits for an app: ";

/// The services that read the truth of a scenario, with their sensor numbers.
inline std::vector<ServiceKey> truth_consumers(const LoadedScenario& scenario) {
  std::vector<ServiceKey> services;
  for_each_sensor(scenario, [&services](auto kind, const auto& sensor) {
    services.emplace_back(decltype(kind)::type::service, sensor.number);
  });
  services.emplace_back(catalog::kTruthLogger, 0u);
  return services;
}

/// Those that must be ready before the first sample.
inline std::vector<ServiceKey> required_services(const LoadedScenario& scenario) {
  std::vector<ServiceKey> services = truth_consumers(scenario);
  if (scenario.scenario.reference_nav) services.emplace_back(catalog::kReferenceNav, 0u);
  return services;
}

/// Our consumers of a stream of sensor `number`: the logger, and the reference navigation app where it navigates by it,
/// which is by the first stream of a kind.
template <class Sample>
std::vector<ServiceKey> stream_consumers(const Scenario& scenario, std::uint32_t number) {
  using Kind = catalog::SourceOf<Sample>;
  std::vector<ServiceKey> services{{catalog::kTruthLogger, 0u}};
  const auto& app = scenario.reference_nav;
  if (std::is_same_v<Sample, catalog::FirstSampleOf<Kind>> && app && is_of_the_app<Kind>(*app, number)) {
    services.emplace_back(catalog::kReferenceNav, 0u);
  }
  return services;
}

}  // namespace inslab::scenario
