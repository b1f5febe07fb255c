#pragma once

#include <string>

#include "inslab/models/navigation/parameters.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::sim {

/// Writes a scenario that was put together in memory as files that the services can load: the scenario, a file for each
/// profile, the rows of its trajectory, and the parameters of the reference navigation app that it names. Returns the
/// scenario's path. Throws files::WriteError.
std::string write_scenario_folder(const scenario::LoadedScenario& loaded,
                                  const navigation::NavigationParameters& parameters, const std::string& folder);

}  // namespace inslab::sim
