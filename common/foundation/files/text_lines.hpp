#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "inslab/foundation/files/input_file.hpp"

namespace inslab::files {

/// The lines of a text file, one after the other; never the whole file in memory. Lines end in \n or \r\n, the last one
/// may end with the file.
class TextLines {
 public:
  /// No line of a format that Inslab knows comes near this.
  static constexpr std::size_t kMaxLineBytes = std::size_t{1} << 16;

  /// Throws ReadError when the file cannot be opened.
  explicit TextLines(const std::string& path);

  /// The next line without its end, valid until the next call; false after the last. Throws ReadError when a line is
  /// longer than kMaxLineBytes (a file that is not text) or the file cannot be read.
  bool next(std::string_view& line);

  /// Of the line that next() gave last, from 1.
  std::uint64_t number() const { return number_; }
  const std::string& path() const { return file_.path(); }

 private:
  bool refill();

  InputFile file_;
  std::uint64_t offset_ = 0;  ///< of the file: what comes after the buffer
  std::string buffer_;
  std::size_t at_ = 0;  ///< in the buffer: where the next line begins
  std::uint64_t number_ = 0;
};

/// `text` without spaces, tabs and \r at both ends.
std::string_view trimmed(std::string_view text);

/// The fields of a line: what lies between `separator`s, trimmed; with ' ' what lies between runs of spaces and tabs.
void split(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// The number that all of `text` is, whatever the locale ("1e-3", "-.5", "+7", "nan"); nothing when it is none.
std::optional<double> number_from(std::string_view text);

/// The decimal number that all of `text` is; nothing when it is none or does not fit.
std::optional<std::int64_t> integer_from(std::string_view text);

/// The number that all of `text` is in hexadecimal digits; nothing when it is none or does not fit.
std::optional<std::uint32_t> hex_from(std::string_view text);

}  // namespace inslab::files
