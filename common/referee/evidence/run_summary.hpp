#pragma once

#include <optional>
#include <string>

#include "inslab/foundation/host/outcome.hpp"

namespace inslab::cli {

/// Prints what a log says about a run: per topic what was sent, received, lost and how old it was; per swap its
/// acknowledgement, its first sample and the noise measured before and after beside what the profiles promise; the
/// checks that did not hold; the path of the log. Of a log of `inslab simulate`, which has no services, the streams and
/// the swaps are checked. `failure` is what the one who ran it saw go wrong, if anything. What it comes to: kFailed
/// with the first check that did not hold. Throws io::ReadError, config::Error.
app::Outcome print_run_summary(const std::string& log_path, const std::optional<std::string>& failure);

}  // namespace inslab::cli
