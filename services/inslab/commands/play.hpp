#pragma once

#include <optional>
#include <vector>

#include "inslab/bus/service/service_options.hpp"
#include "inslab/data/catalog/any_profile.hpp"

namespace inslab::commands {

/// Where swaps are played, and how long their answers are waited for.
struct PlayOptions {
  std::optional<double> timeout_s;  ///< absent: as long as the run goes on
  service::NetworkOptions network;

  void add_to(CLI::App& command);
};

/// Plays swaps on a running set, says what becomes of each, and returns the exit code.
int play_and_tell(const std::vector<catalog::AnyProfile>& swaps, const PlayOptions& options);

}  // namespace inslab::commands
