#pragma once

#include <string>
#include <utility>
#include <vector>

#include "inslab/scenario/load.hpp"

namespace inslab::app {

using ServiceKey = std::pair<std::string, std::uint32_t>;  // service, sensor number

inline constexpr const char* kTrajectoryServer = "inslab-trajectory-server";
inline constexpr const char* kImuInjector = "inslab-imu-injector";
inline constexpr const char* kGnssEmulator = "inslab-gnss-emulator";
inline constexpr const char* kTruthLogger = "inslab-truth-logger";
inline constexpr const char* kReferenceNav = "inslab-reference-nav";
/// The app under test, in credits: it is not ours and need not know of them.
inline constexpr const char* kNavApp = "navigation app";
/// What the message of a service begins with that was told to stop in mid-run: its going is no fault of the run's.
inline constexpr const char* kEndedBySignal = "ended by a signal in mid-run";

/// How the message of a service begins that is ready but for the app: the service is not what is missing.
inline constexpr const char* kWaitsForApp = "waits for an app: ";

/// The services that read the truth of a scenario, with their sensor numbers.
inline std::vector<ServiceKey> truth_consumers(const scenario::LoadedScenario& scenario) {
  std::vector<ServiceKey> services;
  for (const auto& imu : scenario.imus) services.emplace_back(kImuInjector, imu.number);
  for (const auto& gnss : scenario.gnss) services.emplace_back(kGnssEmulator, gnss.number);
  services.emplace_back(kTruthLogger, 0u);
  return services;
}

/// Those that must be ready before the first sample.
inline std::vector<ServiceKey> required_services(const scenario::LoadedScenario& scenario) {
  std::vector<ServiceKey> services = truth_consumers(scenario);
  if (scenario.scenario.reference_nav) services.emplace_back(kReferenceNav, 0u);
  return services;
}

/// Our consumers of the stream of a sensor: the logger, and the reference navigation app where it navigates by it.
inline std::vector<ServiceKey> stream_consumers(const scenario::Scenario& scenario, SensorKind kind,
                                                std::uint32_t number) {
  std::vector<ServiceKey> services{{kTruthLogger, 0u}};
  const auto& app = scenario.reference_nav;
  if (app && number == (kind == SensorKind::Imu ? app->imu : app->gnss)) services.emplace_back(kReferenceNav, 0u);
  return services;
}

}  // namespace inslab::app
