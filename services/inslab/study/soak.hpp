#pragma once

#include <functional>
#include <string>

#include "inslab/services/inslab/live/live_run.hpp"

namespace inslab::study {

/// A run in lockstep that swaps, kills and pauses for hours of sim time.
struct SoakOptions {
  live::RunOptions run;
  double hours = 24.0;
  std::uint64_t seed = 1;
  double often = 1.0;    ///< so many times as many kills and pauses
  int load = 0;          ///< busy threads beside the set
  std::string profiles;  ///< folder with those to swap to, by kind
};

/// Takes the place for a set when it is made, and soaks one run. What it finds is said as it is found.
class Soak {
 public:
  using Say = std::function<void(const std::string&)>;

  /// All are used until the end. Throws service::PlaceTaken, and as SoakEvents does.
  Soak(const SoakOptions& options, const scenario::LoadedScenario& scenario, Say say);
  ~Soak();
  Soak(const Soak&) = delete;
  Soak& operator=(const Soak&) = delete;

  /// True when everything held.
  bool go();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace inslab::study
