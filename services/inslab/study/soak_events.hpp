#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "inslab/data/catalog/any_profile.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::study {

/// What a soak does to a running set, drawn from a seed: swaps of every kind of profile, kills of one service, of two
/// at once and of one that is just told of a swap, pauses, each at random sim times with a mean distance of its own.
class SoakEvents {
 public:
  enum class Kind { Swap, Kill, KillTwo, KillInSwap, Pause };
  struct Event {
    Kind kind;
    double at_s;  ///< sim time
  };

  /// `profiles` is a folder with imu, vibration, gnss and installation; of all but swaps there are `often` times as
  /// many as usual. Throws std::runtime_error when a folder has no profile, json::Error when one cannot be read.
  SoakEvents(const scenario::LoadedScenario& scenario, const std::filesystem::path& profiles, std::uint64_t seed,
             double often = 1.0);

  /// Whether something is due at this sim time; each event comes once.
  std::vector<Event> due(double sim_time_s);
  /// A swap for a sensor of the scenario.
  catalog::AnyProfile next_swap();
  /// A whole number below `end`.
  std::size_t pick(std::size_t end);

 private:
  struct Source {
    Kind kind;
    double mean_s;
    double next_s = 0.0;
  };

  double wait_s(double mean_s);
  void add_profiles(const std::filesystem::path& folder, ProfileKind kind, const SensorAddress& sensor,
                    const std::string& prefix = "");

  std::mt19937_64 random_;
  std::vector<Source> sources_{{Kind::Swap, 20.0},
                               {Kind::Kill, 900.0},
                               {Kind::KillTwo, 3600.0},
                               {Kind::KillInSwap, 1800.0},
                               {Kind::Pause, 600.0}};
  std::vector<catalog::AnyProfile> profiles_;
  std::uint64_t next_request_ = 1;
};

}  // namespace inslab::study
