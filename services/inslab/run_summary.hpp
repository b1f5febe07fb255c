#pragma once

#include <optional>
#include <string>

namespace inslab::cli {

/// Prints what a log says about a live run: per topic what was sent, received, lost and how old it was; per swap its
/// acknowledgement, its first sample and the noise measured before and after beside what the profiles promise; the
/// checks that did not hold; the path of the log. `failure` is what the one who ran it saw go wrong, if anything.
/// True when nothing was lost and every check held. Throws io::ReadError, config::Error.
bool print_run_summary(const std::string& log_path, const std::optional<std::string>& failure);

}  // namespace inslab::cli
