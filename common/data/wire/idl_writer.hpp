#pragma once

#include <string>

namespace inslab::wire {

/// The text of idl/profile.idl, derived from the declarations of the profile parameters in common/data/profiles.
/// The file in idl/ is this text; a test fails when they differ.
std::string profile_idl();

/// The text of idl/block.idl, derived from the catalogue's streams; held current in the same way.
std::string block_idl();

}  // namespace inslab::wire
