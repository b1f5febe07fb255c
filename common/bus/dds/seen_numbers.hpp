#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <utility>

namespace inslab::dds {

/// Which of the numbers of one writer have come. Knows every one, whatever came before, in little memory: what came
/// without a gap is one entry. Of more gaps than a writer that is repaired has at once the oldest count as closed.
class SeenNumbers {
 public:
  using Ranges = std::map<std::uint64_t, std::uint64_t>;  ///< first number to last

  SeenNumbers() = default;
  /// Goes on from the ranges of another one.
  explicit SeenNumbers(Ranges ranges) : ranges_(std::move(ranges)) {}

  /// True the first time a number comes.
  bool insert(std::uint64_t number) {
    if (number < floor_) return false;
    auto after = ranges_.upper_bound(number);
    const bool in_range = after != ranges_.begin() && number <= std::prev(after)->second;
    if (in_range) return false;
    const bool extends_before = after != ranges_.begin() && std::prev(after)->second + 1 == number;
    const bool extends_after = after != ranges_.end() && after->first == number + 1;
    const std::uint64_t last = extends_after ? after->second : number;
    if (extends_after) after = ranges_.erase(after);
    if (extends_before) {
      std::prev(after)->second = last;
    } else {
      ranges_.emplace_hint(after, number, last);
    }
    if (ranges_.size() > kMostRanges) {
      floor_ = std::next(ranges_.begin())->first;
      ranges_.erase(ranges_.begin());
    }
    return true;
  }

  /// What came without a gap, the newest of it at most.
  const Ranges& ranges() const { return ranges_; }
  /// The greatest that came; 0: none.
  std::uint64_t last() const { return ranges_.empty() ? 0 : ranges_.rbegin()->second; }
  /// How many after `number` have not come, though a greater one has.
  std::uint64_t missing_after(std::uint64_t number) const {
    std::uint64_t missing = 0;
    for (const auto& [first, end] : ranges_) {
      if (first > number + 1) missing += first - number - 1;
      number = std::max(number, end);
    }
    return missing;
  }

  static constexpr std::size_t kMostRanges = 256;

 private:
  std::uint64_t floor_ = 0;  ///< everything below counts as seen
  Ranges ranges_;
};

/// The same of many writers: whether a sample is one that came before. Of more writers than any network has those that
/// were silent for longest are forgotten.
class SeenSamples {
 public:
  using Writer = std::array<std::uint8_t, 16>;

  /// True the first time a writer's number comes.
  bool insert(const Writer& writer, std::uint64_t number) {
    Heard& heard = writers_[writer];
    heard.at = ++clock_;
    const bool is_new = heard.numbers.insert(number);
    if (writers_.size() > kMostWriters) {
      writers_.erase(std::min_element(writers_.begin(), writers_.end(),
                                      [](const auto& a, const auto& b) { return a.second.at < b.second.at; }));
    }
    return is_new;
  }

 private:
  static constexpr std::size_t kMostWriters = 1024;
  struct Heard {
    SeenNumbers numbers;
    std::uint64_t at = 0;
  };

  std::map<Writer, Heard> writers_;
  std::uint64_t clock_ = 0;
};

}  // namespace inslab::dds
