#pragma once

#include <string>
#include <vector>

namespace inslab::text {

/// The known word that `word` was most likely meant to be: at most two letters inserted, removed, changed or swapped,
/// and fewer than half of it; empty when there is none.
std::string nearest(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean 'run'?", or nothing when no known word is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace inslab::text
