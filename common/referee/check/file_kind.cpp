#include "inslab/referee/check/file_kind.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/formats/recordings/imu_columns.hpp"
#include "inslab/formats/trajectory/rtklib_columns.hpp"
#include "inslab/formats/trajectory/trajectory_columns.hpp"
#include "inslab/formats/trajectory/trajectory_nmea.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_file.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::check {

namespace {

using Form = FileKind::Form;

bool begins_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

/// That is no space and no mark of the byte order; '\0': there is none in the beginning of the file.
char first_character(const files::InputFile& file) {
  std::array<std::uint8_t, 256> head{};
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(head.size(), file.size()));
  file.read(0, head.data(), size);
  std::string_view text(reinterpret_cast<const char*>(head.data()), size);
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (begins_with(text, kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t found = text.find_first_not_of(" \t\r\n");
  return found == std::string_view::npos ? '\0' : text[found];
}

bool is_log(const files::InputFile& file) {
  constexpr std::array<std::uint8_t, 5> kMagic{0x89, 'M', 'C', 'A', 'P'};
  std::array<std::uint8_t, kMagic.size()> head{};
  if (file.size() < head.size()) return false;
  file.read(0, head.data(), head.size());
  return head == kMagic;
}

/// What a line of names says; nothing when too few of them are known.
std::optional<Form> form_of_names(std::string_view line) {
  std::vector<std::string_view> names;
  files::split(line, line.find(',') == std::string_view::npos ? ' ' : ',', names);
  int axes = 0, positions = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto imu = recordings::imu_column_named(names[i], i);
    if (imu && imu->axis >= 0) ++axes;
    const auto row = trajectory::column_named(names[i]);
    const bool is_position =
        row && (row->quantity == trajectory::Quantity::Latitude || row->quantity == trajectory::Quantity::Longitude ||
                row->quantity == trajectory::Quantity::Height);
    if (is_position) ++positions;
  }
  if (axes == 0 && positions < 2) return std::nullopt;
  return axes > positions ? Form::Recording : Form::Trajectory;
}

/// Rows of numbers without names. Seven are increments of an IMU or a fix: an increment of more than half a radian or
/// half a metre per second is of no IMU, and no fix lies within that of latitude, longitude and height 0.
Form form_of_numbers(const std::vector<std::string_view>& fields) {
  if (fields.size() == 4) return Form::MotionMatrix;
  if (fields.size() == 11 || fields.size() == 13) return Form::Trajectory;
  if (fields.size() != 7) return Form::Unknown;
  constexpr double kIncrement = 0.5;
  const bool is_small = std::all_of(fields.begin() + 1, fields.begin() + 4, [](std::string_view field) {
    return std::abs(files::number_from(field).value_or(1.0)) < kIncrement;
  });
  return is_small ? Form::Recording : Form::Trajectory;
}

Form form_of_text(const std::string& path) {
  constexpr std::uint64_t kLinesLookedAt = 200;
  files::TextLines lines(path);
  std::vector<std::string_view> fields;
  for (std::string_view line; lines.number() < kLinesLookedAt && lines.next(line);) {
    line = files::trimmed(line);
    if (line.empty()) continue;
    if (begins_with(line, "%RAWIMU") || begins_with(line, "#RAWIMU")) return Form::NovatelLog;
    if (trajectory::is_nmea_sentence(line)) return Form::Trajectory;
    const bool is_comment = line.front() == '#' || line.front() == '%';
    const std::string_view names =
        is_comment ? line.substr(std::min(line.size(), line.find_first_not_of("#% \t"))) : line;
    if (const auto form = form_of_names(names)) return *form;
    if (trajectory::rtklib_columns(names)) return Form::Trajectory;
    if (is_comment) continue;
    files::split(line, line.find(',') == std::string_view::npos ? ' ' : ',', fields);
    const bool is_dated = fields.size() > 2 && fields.front().find('/') != std::string_view::npos;
    if (is_dated) return Form::Trajectory;
    return std::all_of(fields.begin(), fields.end(),
                       [](std::string_view f) { return files::number_from(f).has_value(); })
               ? form_of_numbers(fields)
               : Form::Unknown;
  }
  return Form::Unknown;
}

}  // namespace

FileKind file_kind(const std::string& path) {
  FileKind kind;
  bool is_document = false;
  {
    const files::InputFile file(path);
    if (is_log(file)) {
      kind.form = Form::Log;
      return kind;
    }
    const char first = first_character(file);
    if (first == '\0') throw files::ReadError(path + ": is empty, or no text");
    is_document = first == '{' || first == '[';
  }
  if (!is_document) {
    kind.form = form_of_text(path);
    return kind;
  }
  kind.form = Form::Document;
  kind.json = json::read_json_file(path);
  kind.document = scenario::document_kind(kind.json);
  return kind;
}

}  // namespace inslab::check
