#pragma once

#include <stdexcept>

namespace inslab::host {

/// An argument of a command is wrong, whatever its files say.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace inslab::host
