#include "tests/mutations/mutator.hpp"

#include <algorithm>
#include <array>

namespace inslab::mutations {

namespace {

constexpr std::array<const char*, 31> kNumbers{"0",
                                               "-1",
                                               "1",
                                               "1e308",
                                               "-1e308",
                                               "1e309",
                                               "1e-320",
                                               "-0.0",
                                               "nan",
                                               "NaN",
                                               "inf",
                                               "-Infinity",
                                               "9223372036854775807",
                                               "-9223372036854775808",
                                               "18446744073709551616",
                                               "4294967296",
                                               "2147483648",
                                               "1e9",
                                               "1e-9",
                                               "0.1",
                                               "604799.9999999999",
                                               "604800",
                                               "90",
                                               "180.0000001",
                                               "1e",
                                               "0x10",
                                               "1,5",
                                               "--1",
                                               "1.2.3",
                                               "true",
                                               "null"};

constexpr std::array<const char*, 18> kWords{"",
                                             " ",
                                             "\"",
                                             "{",
                                             "}",
                                             "[",
                                             "]",
                                             ",",
                                             ":",
                                             "\n",
                                             "\t",
                                             "#",
                                             "\x1b[31mred\x1b[0m",
                                             "\xe2\x80\xae",
                                             "\xff\xfe",
                                             "\xd0\xb8\xd0\xbc\xd1\x8f",
                                             "..",
                                             "-"};

bool is_of_number(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e'; }

}  // namespace

std::string Mutator::mutated(std::string bytes, bool is_text) {
  const std::size_t changes = 1 + below(4);
  for (std::size_t i = 0; i < changes; ++i) {
    if (is_text && below(4) != 0) {
      change_text(bytes);
    } else {
      change_bytes(bytes);
    }
  }
  return bytes;
}

void Mutator::change_bytes(std::string& bytes) {
  const std::size_t at = below(bytes.size());
  const std::size_t length = std::min(bytes.size() - at, std::size_t{1} << below(12));
  switch (below(7)) {
    case 0:
      bytes.resize(at);
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(below(bytes.size() + 1), bytes.substr(at, length));
      break;
    case 3:
      bytes.insert(at, std::string(length, static_cast<char>(below(256))));
      break;
    case 4:
      for (std::size_t i = 0; i < length; ++i) bytes[at + i] = static_cast<char>(below(256));
      break;
    default:
      if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ static_cast<char>(1u << below(8)));
  }
}

void Mutator::change_text(std::string& text) {
  switch (below(6)) {
    case 0:
      text.insert(below(text.size() + 1), kWords[below(kWords.size())]);
      break;
    case 1: {
      constexpr std::array<const char*, 7> kDeep{"[", "{\"a\":", "(", "<a>", "- ", "((", "\""};
      std::string deep;
      const std::string one = kDeep[below(kDeep.size())];
      for (std::size_t i = std::size_t{1} << below(14); i > 0; --i) deep += one;
      text.insert(below(text.size() + 1), deep);
      break;
    }
    case 2:
      change_lines(text);
      break;
    default:
      change_number(text);
  }
}

/// A number becomes another one, or none.
void Mutator::change_number(std::string& text) {
  const std::size_t from = below(text.size());
  const auto begin = std::find_if(text.begin() + static_cast<std::ptrdiff_t>(from), text.end(),
                                  [](char c) { return c >= '0' && c <= '9'; });
  const auto end = std::find_if_not(begin, text.end(), is_of_number);
  text.replace(begin, end, kNumbers[below(kNumbers.size())]);
}

/// Lines are lost, doubled or change places.
void Mutator::change_lines(std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1);
    lines.push_back(text.substr(at, end + 1 - at));
    at = end + 1;
  }
  if (lines.empty()) return;
  const std::size_t a = below(lines.size()), b = below(lines.size());
  switch (below(3)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(a));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(a), lines[b]);
      break;
    default:
      std::swap(lines[a], lines[b]);
  }
  text.clear();
  for (const std::string& line : lines) text += line;
}

}  // namespace inslab::mutations
