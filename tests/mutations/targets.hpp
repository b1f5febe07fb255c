#pragma once

#include <string>
#include <vector>

#include "tests/mutations/seeds.hpp"

namespace inslab::mutations {

/// Reads the file as what the seed is, with all that a command would do to it. Returns when it is good; throws what the
/// command would catch.
void read(const std::string& path, const Seed& seed, const std::string& folder);

}  // namespace inslab::mutations
