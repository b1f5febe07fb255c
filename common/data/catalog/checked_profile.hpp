#pragma once

#include <stdexcept>
#include <string>

#include "inslab/data/catalog/profile_rules.hpp"
#include "inslab/data/catalog/sensor_kinds.hpp"

namespace inslab::catalog {

/// The profile itself, when a model of that kind of sensor may take it. Throws std::invalid_argument, naming what
/// breaks a rule of data/catalog/profile_rules.hpp, or that it is for another kind.
template <class Kind, class Profile>
const Profile& checked_for(const Profile& profile) {
  if (const auto broken = violation(profile)) throw std::invalid_argument(broken->path + " " + broken->reason);
  if (profile.target.kind != Kind::kind) throw std::invalid_argument("target_kind is not " + std::string(Kind::name));
  return profile;
}

}  // namespace inslab::catalog
