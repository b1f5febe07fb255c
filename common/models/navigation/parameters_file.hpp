#pragma once

#include <string>

#include "inslab/models/navigation/parameters.hpp"

namespace inslab::navigation {

/// The parameters of a file. Throws json::Error, naming file, path in it and reason, for what a declaration or a rule
/// refuses.
NavigationParameters read_parameters(const std::string& file);

}  // namespace inslab::navigation
