#pragma once

#include <string>
#include <utility>
#include <vector>

#include "scenario/load.hpp"

namespace inslab::app {

inline constexpr const char* kTrajectoryServer = "inslab-trajectory-server";
inline constexpr const char* kImuInjector = "inslab-imu-injector";
inline constexpr const char* kGnssEmulator = "inslab-gnss-emulator";
inline constexpr const char* kTruthLogger = "inslab-truth-logger";
/// The app under test, in credits: it is not ours and need not know of them.
inline constexpr const char* kNavApp = "navigation app";

/// The services that read the truth of a scenario, with their sensor numbers: all must be ready before its first
/// sample.
inline std::vector<std::pair<std::string, std::uint32_t>> required_services(const scenario::LoadedScenario& scenario) {
  std::vector<std::pair<std::string, std::uint32_t>> services;
  for (const auto& imu : scenario.imus) services.emplace_back(kImuInjector, imu.number);
  for (const auto& gnss : scenario.gnss) services.emplace_back(kGnssEmulator, gnss.number);
  services.emplace_back(kTruthLogger, 0u);
  return services;
}

}  // namespace inslab::app
