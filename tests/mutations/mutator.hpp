#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace inslab::mutations {

/// Spoils a file the way disks, editors, other programs and people do: bits turned, ends cut off, pieces lost, doubled
/// or moved, numbers that are extreme or none, words that are long, deep or in another script.
class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One to four changes. `is_text`: also those that only a text can suffer.
  std::string mutated(std::string bytes, bool is_text);

 private:
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }
  void change_bytes(std::string& bytes);
  void change_text(std::string& text);
  void change_number(std::string& text);
  void change_lines(std::string& text);

  std::mt19937_64 random_;
};

}  // namespace inslab::mutations
