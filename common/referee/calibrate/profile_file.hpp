#pragma once

#include <string>

#include "inslab/data/profiles/gnss_error_profile.hpp"
#include "inslab/data/profiles/imu_error_profile.hpp"

namespace inslab::calibrate {

/// A profile as the text of its JSON file; keys that have their defaults are left out, and three equal axes are one
/// number.
std::string profile_text(const ImuErrorProfile& profile);

/// Writes it. Throws files::WriteError.
void write_profile(const std::string& path, const ImuErrorProfile& profile);
void write_profile(const std::string& path, const GnssErrorProfile& profile);

}  // namespace inslab::calibrate
