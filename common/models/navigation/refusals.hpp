#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace inslab::navigation {

/// Why alignments were refused, each reason once however often it came: two that differ in their numbers alone are one.
class Refusals {
 public:
  /// The reason in force now, asked for as often as wanted; true when it is one that has not been noted.
  bool note(const std::string& why) {
    if (why.empty() || why == last_) return false;
    last_ = why;
    const auto found = std::find_if(reasons_.begin(), reasons_.end(), [&](const std::string& reason) {
      return without_numbers(reason) == without_numbers(why);
    });
    if (found != reasons_.end()) return false;
    reasons_.push_back(why);
    return true;
  }

  /// In the order in which they came first, as they were then; empty: none.
  std::string words() const {
    std::string text;
    for (const std::string& reason : reasons_) text += (text.empty() ? "" : "; ") + reason;
    return text;
  }

 private:
  static std::string without_numbers(std::string text) {
    const auto is_of_number = [](char c) {
      return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
    };
    text.erase(std::remove_if(text.begin(), text.end(), is_of_number), text.end());
    return text;
  }

  std::string last_;
  std::vector<std::string> reasons_;
};

}  // namespace inslab::navigation
