#include "inslab/data/json/json_reader.hpp"

namespace inslab::json::detail {

std::string nearest_key(const std::string& key, const std::vector<std::string>& known) {
  std::string meant = text::nearest(key, known);
  if (!meant.empty()) return meant;
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

}  // namespace inslab::json::detail
