#pragma once

#include <filesystem>

namespace inslab::dds {

/// What users other than the owner (and root) may do with a file. Its mode and, where it has one, its access list are
/// looked at: with a list, the mode's group bits are no group's rights but the most that the list grants anybody.
struct AccessOfOthers {
  bool read = false;
  bool write = false;
};

/// Throws std::runtime_error naming the file when it cannot be looked at.
AccessOfOthers access_of_others(const std::filesystem::path& file);

/// The mode's permission bits, as chmod takes them: "0640".
std::string mode_text(const std::filesystem::path& file);

}  // namespace inslab::dds
