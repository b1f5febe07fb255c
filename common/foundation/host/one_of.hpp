#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "inslab/foundation/text/nearest.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::host {

/// The check of an option or argument whose value is one of these words: what else is given is named, with the words
/// there are and the one that was most likely meant.
inline CLI::Validator one_of(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ",") + word;
  const auto judge = [words, list](std::string& given) {
    if (std::find(words.begin(), words.end(), given) != words.end()) return std::string();
    return "is " + text::quoted(given) + "; expected one of " + list + text::did_you_mean(given, words);
  };
  return CLI::Validator(judge, "{" + list + "}");
}

}  // namespace inslab::host
