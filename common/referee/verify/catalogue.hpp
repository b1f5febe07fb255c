#pragma once

#include <string>
#include <vector>

#include "inslab/data/json/json_reader.hpp"
#include "inslab/scenario/scenario.hpp"

namespace inslab::verify {

/// The names of the scenarios in config/scenarios that are made of a motion table, demos aside.
const std::vector<std::string>& catalogue();

/// One of them, as its file was when the program was built, so that it needs no folder to look in. Profiles are named,
/// not read. Throws std::out_of_range for another name, json::Error when the file breaks a rule.
scenario::Scenario catalogue_scenario(const std::string& name);

/// The text of a file of config/profiles, such as imu/stim300, as it was when the program was built. Throws
/// std::out_of_range for one that is not among them.
const std::string& catalogue_profile_text(const std::string& name);

/// The profile in it. Throws also json::Error when the text breaks a rule.
template <class Profile>
Profile catalogue_profile(const std::string& name) {
  return json::struct_from_json<Profile>(json::parse_json(catalogue_profile_text(name), name), name);
}

}  // namespace inslab::verify
