#pragma once

#include <string>

namespace inslab::cli {

/// What `inslab trajectory check FILE` does; returns its exit code.
int check_trajectory(const std::string& file);

}  // namespace inslab::cli
