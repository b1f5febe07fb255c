#pragma once

#include <stdexcept>

namespace inslab::app {

/// An argument of a command is wrong, whatever its files say.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace inslab::app
