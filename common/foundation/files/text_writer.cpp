#include "inslab/foundation/files/text_writer.hpp"

#include <charconv>
#include <utility>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::files {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

}  // namespace

TextWriter::TextWriter(const std::string& path, std::string_view separator) : file_(path), separator_(separator) {}

TextWriter& TextWriter::number(double value, int decimals) {
  char digits[352];  // the largest double has 309 digits before its point
  const auto end = std::to_chars(digits, digits + sizeof(digits), value, std::chars_format::fixed, decimals).ptr;
  return text({digits, static_cast<std::size_t>(end - digits)});
}

TextWriter& TextWriter::integer(std::int64_t value) { return text(std::to_string(value)); }

TextWriter& TextWriter::text(std::string_view value) {
  begin_field();
  buffer_ += value;
  return *this;
}

void TextWriter::end_line() {
  buffer_ += '\n';
  in_line_ = false;
  if (buffer_.size() >= kBufferSize) drain();
}

void TextWriter::close() {
  drain();
  file_.close();
}

void TextWriter::begin_field() {
  if (in_line_) buffer_ += separator_;
  in_line_ = true;
}

void TextWriter::drain() {
  const std::string ready = std::exchange(buffer_, {});
  if (!ready.empty()) file_.append(reinterpret_cast<const std::uint8_t*>(ready.data()), ready.size());
}

}  // namespace inslab::files
