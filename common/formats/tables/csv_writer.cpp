#include "inslab/formats/tables/csv_writer.hpp"

#include <charconv>
#include <utility>

#include "inslab/foundation/files/file_error.hpp"

namespace inslab::tables {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

void put_text(std::string_view text, std::string& out) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

struct CellText {
  std::string& out;

  void operator()(std::monostate) const {}
  void operator()(bool value) const { out += value ? '1' : '0'; }
  void operator()(const EnumCell& value) const { put_text(value.name, out); }
  void operator()(const std::string& value) const { put_text(value, out); }
  template <class Number>
  void operator()(Number value) const {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
    out.append(digits, end);
  }
};

}  // namespace

std::string csv_text(const Cell& cell) {
  std::string text;
  std::visit(CellText{text}, cell);
  return text;
}

CsvWriter::CsvWriter(const std::string& path, const std::vector<Column>& columns) : file_(path) {
  for (const Column& column : columns) {
    if (&column != &columns.front()) buffer_ += ',';
    put_text(column.name, buffer_);
  }
  buffer_ += '\n';
}

void CsvWriter::row(const Row& cells) {
  for (const Cell& cell : cells) {
    if (&cell != &cells.front()) buffer_ += ',';
    std::visit(CellText{buffer_}, cell);
  }
  buffer_ += '\n';
  if (buffer_.size() >= kBufferSize) drain();
}

void CsvWriter::close() {
  drain();
  file_.close();
}

void CsvWriter::drain() {
  const std::string ready = std::exchange(buffer_, {});
  if (!ready.empty()) file_.append(reinterpret_cast<const std::uint8_t*>(ready.data()), ready.size());
}

}  // namespace inslab::tables
