#pragma once

namespace inslab::host {

/// What every command of the product returns to the shell.
enum ExitCode : int {
  kOk = 0,
  kFailed = 1,       ///< the work was done and a check did not hold, or it could not be done
  kBadInput = 2,     ///< a file or an argument is wrong; nothing was started
  kNotApplied = 3,   ///< a swap was rejected or not acknowledged
  kNotAccepted = 4,  ///< an acceptance limit of the scenario was missed
};

}  // namespace inslab::host
