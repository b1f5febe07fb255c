#pragma once

#include <vector>

#include "inslab/services/inslab/derived/derived_files.hpp"

namespace inslab::derived {

/// What deploy takes from the catalogue, which is C++: the roles for make-keys, the services for inventories of labs,
/// the units of the sensors' services.
std::vector<DerivedFile> deploy_files();

}  // namespace inslab::derived
