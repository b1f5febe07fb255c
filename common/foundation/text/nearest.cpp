#include "inslab/foundation/text/nearest.hpp"

#include <algorithm>

namespace inslab::text {

namespace {

/// Damerau's distance: letters to insert, remove or change, neighbours to swap.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1), row[j] + 1, next[j - 1] + 1});
      const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (is_swap) next[j] = std::min(next[j], before[j - 2] + 1);
    }
    std::swap(before, row);
    std::swap(row, next);
  }
  return row[b.size()];
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kMostEdits = 2;
  std::string best;
  std::size_t least = kMostEdits + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > word.size() + kMostEdits || word.size() > candidate.size() + kMostEdits) continue;
    const std::size_t edits = edits_between(word, candidate);
    if (edits >= least || 2 * edits >= candidate.size()) continue;
    least = edits;
    best = candidate;
  }
  return best;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& known) {
  const std::string meant = nearest(word, known);
  return meant.empty() ? "" : "; did you mean '" + meant + "'?";
}

}  // namespace inslab::text
