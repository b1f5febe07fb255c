#pragma once

#include <string>

namespace inslab::cli {

/// Runs a gnuplot script. Throws std::runtime_error with what gnuplot said when it is not installed (Debian:
/// gnuplot-nox) or does not like the script.
void gnuplot(const std::string& script);

}  // namespace inslab::cli
