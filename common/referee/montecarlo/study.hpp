#pragma once

#include "inslab/data/json/json_file.hpp"
#include "inslab/models/navigation/app_setup.hpp"

namespace inslab::montecarlo {

/// What the runs of a study share.
struct Study {
  scenario::LoadedScenario loaded;  ///< with the reference navigation app, whether or not its file has it
  navigation::AppSetup app;
  bool draw_start = false;  ///< begin at the truth plus errors drawn from the filter's initial sigmas
  json::Json description;   ///< all of the above, the seed of run 0 included, and the program's version
  std::string fingerprint;  ///< 64 bits drawn from the description, in hexadecimal

  /// Run k has the scenario's seed plus k: run 0 is the scenario's own.
  std::uint64_t seed_of(std::uint32_t run) const { return loaded.scenario.seed + run; }
};

/// Reads a scenario and the filter's parameters: those of a file when one is named, else the scenario's. Throws
/// json::Error for what a file has wrong, files::ReadError when the scenario follows a live vehicle, or lacks an IMU or
/// a receiver to navigate by.
Study load_study(const std::string& scenario_file, const std::string& parameters_file, bool draw_start,
                 const std::string& version);

}  // namespace inslab::montecarlo
