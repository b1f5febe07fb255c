#pragma once

#include <string>

#include "inslab/scenario/load.hpp"

namespace inslab::service {

/// SHA-256, in hexadecimal, of a scenario and of everything it names: its parameters with every default, the seed among
/// them, the contents of its profiles, of its swaps' profiles and of its trajectory's file. Layout and comments of the
/// files do not count, nor does where they lie. Throws files::ReadError when the trajectory's file cannot be read.
std::string scenario_hash(const scenario::LoadedScenario& loaded);

}  // namespace inslab::service
