#pragma once

#include <string>

#include "inslab/foundation/host/exit_code.hpp"

namespace inslab::host {

/// What one part of a command's work came to.
struct Outcome {
  ExitCode code = kOk;
  std::string reason;  ///< one line, to be the last one that a user reads

  /// "result: FAILED, exit code 1: inslab/imu/0: 6000 sent, 744 received"
  std::string words() const {
    if (code == kOk) return "result: passed" + (reason.empty() ? "" : ": " + reason);
    return std::string("result: ") + (code == kNotAccepted ? "NOT ACCEPTED" : "FAILED") + ", exit code " +
           std::to_string(code) + (reason.empty() ? "" : ": " + reason);
  }
};

/// How bad an ending is: a missed limit is a finding about the app under test, a check of the set that does not hold
/// puts even that finding in doubt, and of wrong input there is no finding at all.
constexpr int badness(ExitCode code) {
  switch (code) {
    case kOk:
      return 0;
    case kNotApplied:
      return 1;
    case kNotAccepted:
      return 2;
    case kFailed:
      return 3;
    case kBadInput:
      return 4;
  }
  return 4;
}

/// The worse of two; the first where they are as bad.
inline Outcome worse(const Outcome& a, const Outcome& b) { return badness(b.code) > badness(a.code) ? b : a; }

}  // namespace inslab::host
