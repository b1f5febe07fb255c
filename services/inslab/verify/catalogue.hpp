#pragma once

#include <string>
#include <vector>

#include "scenario/scenario.hpp"

namespace inslab::verify {

/// The names of the scenarios in config/scenarios that are made of a motion table, demos aside.
const std::vector<std::string>& catalogue();

/// One of them, as its file was when the program was built, so that it needs no folder to look in. Profiles are named,
/// not read. Throws std::out_of_range for another name, config::Error when the file breaks a rule.
scenario::Scenario catalogue_scenario(const std::string& name);

}  // namespace inslab::verify
