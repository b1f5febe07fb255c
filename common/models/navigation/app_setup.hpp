#pragma once

#include <string>
#include <vector>

#include "inslab/models/navigation/parameters.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::navigation {

/// What the app is told of the unit it sits in.
struct AppSetup {
  NavigationParameters parameters;
  nav::Gravity gravity;
  scenario::ReferenceNav app;  ///< which sensors' streams the filter takes
  /// Names of what the sensors' profiles set and parameters that match them leave out; none when a file gave them.
  std::vector<std::string> left_out;
};

/// For the sensors of a scenario: from the scenario's file of parameters, or those that match the sensors' profiles as
/// the app is told they are mounted. Throws json::Error when the scenario lacks a sensor, or the file is not good.
AppSetup setup_for(const scenario::LoadedScenario& scenario, const scenario::ReferenceNav& app);

}  // namespace inslab::navigation
