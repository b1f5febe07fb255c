#pragma once

#include <string>

namespace inslab {
inline namespace samples {

/// A rule that a configuration or a profile breaks: where, and what was expected.
struct Violation {
  std::string path;    ///< such as "segments[3].motions[0].period_s"
  std::string reason;  ///< such as "is 0; the period of a sine lies above 0"
};

}  // namespace samples
}  // namespace inslab
