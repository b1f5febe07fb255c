#pragma once

#include <string>
#include <string_view>

#include "inslab/foundation/files/output_file.hpp"

namespace inslab::files {

/// A text file that is written field by field, with numbers in a fixed number of decimals whatever the locale.
class TextWriter {
 public:
  /// The file has its name when it is closed; `separator` goes between the fields of a line. Throws WriteError.
  TextWriter(const std::string& path, std::string_view separator);

  /// One field of the current line. `decimals` at most 20; the value must be finite.
  TextWriter& number(double value, int decimals);
  TextWriter& integer(std::int64_t value);
  TextWriter& text(std::string_view value);
  /// Throws WriteError.
  void end_line();

  /// Throws WriteError.
  void close();

 private:
  void begin_field();
  void drain();

  OutputFile file_;
  std::string separator_;
  std::string buffer_;
  bool in_line_ = false;
};

}  // namespace inslab::files
