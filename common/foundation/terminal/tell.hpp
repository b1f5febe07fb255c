#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "inslab/foundation/text/shown.hpp"

namespace inslab::terminal {

/// fmt::print() for what may hold names and messages of others: control characters are shown by their number and do
/// not reach the terminal.
template <class... Arguments>
void tell(std::FILE* to, fmt::format_string<Arguments...> pattern, Arguments&&... arguments) {
  const std::string text = text::shown_lines(fmt::format(pattern, std::forward<Arguments>(arguments)...));
  std::fwrite(text.data(), 1, text.size(), to);
}
template <class... Arguments>
void tell(fmt::format_string<Arguments...> pattern, Arguments&&... arguments) {
  tell(stdout, pattern, std::forward<Arguments>(arguments)...);
}

}  // namespace inslab::terminal
