#pragma once

#include <string>

#include "inslab/formats/log/log_info.hpp"

namespace inslab::log {

/// What a log holds, for people: its head, a table of its topics, and what is missing or wrong in them.
std::string text_of(const LogInfo& info);

}  // namespace inslab::log
