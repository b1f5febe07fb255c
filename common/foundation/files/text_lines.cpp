#include "inslab/foundation/files/text_lines.hpp"

#include <algorithm>
#include <charconv>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"

namespace inslab::files {

namespace {

constexpr std::size_t kPieceBytes = std::size_t{1} << 18;

template <class Number, class... Base>
std::optional<Number> whole_text(std::string_view text, Base... base) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// from_chars() takes no plus sign; "+-1" stays a mistake.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

[[noreturn]] void refuse_line(const TextLines& lines) {
  throw ReadError(lines.path() + ": line " + std::to_string(lines.number() + 1) + ": is longer than " +
                  std::to_string(TextLines::kMaxLineBytes) + " bytes; expected a text");
}

}  // namespace

static_assert(TextLines::kMaxLineBytes == kMaxLineBytes, "one limit");

TextLines::TextLines(const std::string& path) : file_(path) {}

bool TextLines::next(std::string_view& line) {
  std::size_t end = buffer_.find('\n', at_);
  while (end == std::string::npos) {
    if (buffer_.size() - at_ > kMaxLineBytes) refuse_line(*this);
    const std::size_t searched = buffer_.size() - at_;
    if (!refill()) break;
    end = buffer_.find('\n', at_ + searched);
  }
  if (end == std::string::npos && at_ == buffer_.size()) return false;
  const bool is_ended = end != std::string::npos;
  if ((is_ended ? end : buffer_.size()) - at_ > kMaxLineBytes) refuse_line(*this);
  line = std::string_view(buffer_).substr(at_, (is_ended ? end : buffer_.size()) - at_);
  at_ = is_ended ? end + 1 : buffer_.size();
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // which editors of one system put before a text
  if (++number_ == 1 && line.substr(0, kByteOrderMark.size()) == kByteOrderMark)
    line.remove_prefix(kByteOrderMark.size());
  return true;
}

bool TextLines::refill() {
  const std::uint64_t left = file_.size() - offset_;
  if (left == 0) return false;
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t kept = buffer_.size();
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(left, kPieceBytes));
  buffer_.resize(kept + count);
  file_.read(offset_, reinterpret_cast<std::uint8_t*>(buffer_.data()) + kept, count);
  offset_ += count;
  return true;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

void split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  if (separator == ' ') {
    constexpr std::string_view kSpaces = " \t";
    for (std::size_t begin = line.find_first_not_of(kSpaces); begin != std::string_view::npos;) {
      const std::size_t end = line.find_first_of(kSpaces, begin);
      fields.push_back(line.substr(begin, end - begin));
      begin = line.find_first_not_of(kSpaces, end);
    }
    return;
  }
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(separator, begin);
    fields.push_back(trimmed(line.substr(begin, end - begin)));
    if (end == std::string_view::npos) return;
    begin = end + 1;
  }
}

std::optional<double> number_from(std::string_view text) { return whole_text<double>(without_plus(text)); }

std::optional<std::int64_t> integer_from(std::string_view text) {
  return whole_text<std::int64_t>(without_plus(text), 10);
}

std::optional<std::uint32_t> hex_from(std::string_view text) { return whole_text<std::uint32_t>(text, 16); }

}  // namespace inslab::files
