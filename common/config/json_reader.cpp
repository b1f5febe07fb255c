#include "config/json_reader.hpp"

namespace inslab::config::detail {

namespace {

/// Levenshtein distance: letters to insert, remove or change.
std::size_t edits_between(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearest_key(const std::string& key, const std::vector<std::string>& known) {
  // A key is a quantity and its unit. A letter or two wrong is the likeliest mistake, then another unit.
  for (const std::string& candidate : known) {
    if (candidate.size() > 3 && key.size() <= candidate.size() + 2 && edits_between(key, candidate) <= 2)
      return candidate;
  }
  std::string best;
  std::size_t best_common = 3;
  for (const std::string& candidate : known) {
    const auto mismatch = std::mismatch(key.begin(), key.end(), candidate.begin(), candidate.end());
    const auto common = static_cast<std::size_t>(mismatch.first - key.begin());
    if (common > best_common) {
      best_common = common;
      best = candidate;
    }
  }
  return best;
}

}  // namespace inslab::config::detail
