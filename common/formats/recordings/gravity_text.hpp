#pragma once

#include <string>

#include "inslab/nav/gravity_grid.hpp"

namespace inslab::recordings {

/// Reads a grid of gravity disturbances from a text: latitude deg, longitude deg, then what is added to gravity to the
/// north, to the east and down, mGal; one knot a line, spaces between, every knot of a regular grid once and in any
/// order. Lines that are empty or begin with # or % are comments. Throws ReadError, naming file, line and what was
/// expected.
nav::GravityGrid read_gravity_grid(const std::string& path);

}  // namespace inslab::recordings
