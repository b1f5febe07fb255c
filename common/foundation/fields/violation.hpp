#pragma once

#include <string>

#include "inslab/foundation/fields/rule.hpp"

namespace inslab {
inline namespace samples {

/// A rule that a configuration or a profile breaks: which, where, and what was expected.
struct Violation {
  Rule rule;
  std::string path;    ///< such as "segments[3].motions[0].period_s"; empty: the whole file
  std::string reason;  ///< such as "is 0; the period of a sine lies above 0"
};

}  // namespace samples
}  // namespace inslab
