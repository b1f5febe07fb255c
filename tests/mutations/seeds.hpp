#pragma once

#include <string>
#include <vector>

namespace inslab::mutations {

/// One good input, and what it is read as.
struct Seed {
  std::string name;  ///< for messages
  std::string what;  ///< the word that the target looks at: a kind of profile, of text, of import
  std::string bytes;
};

std::vector<Seed> scenario_seeds();
std::vector<Seed> profile_seeds();
std::vector<Seed> text_seeds(const std::string& folder);
std::vector<Seed> import_seeds();
/// Logs of a run of two seconds that is simulated in the folder: as it is written, and with nothing compressed and no
/// checksums, so that what is spoiled reaches those who read the messages.
std::vector<Seed> log_seeds(const std::string& folder);

}  // namespace inslab::mutations
