#include "inslab/referee/verify/simulator_log.hpp"

#include <algorithm>

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::verify {

namespace {

/// Lines of comma-separated values below a line of their names.
class NamedColumns {
 public:
  /// The names stand in the first line that begins so.
  NamedColumns(const std::string& path, std::string_view names_begin) : lines_(path) {
    std::string_view line;
    while (lines_.next(line)) {
      if (line.substr(0, names_begin.size()) != names_begin) continue;
      files::split(line, ',', fields_);
      names_.assign(fields_.begin(), fields_.end());
      return;
    }
    throw files::ReadError(path + ": has no line of names that begins with '" + std::string(names_begin) + "'");
  }

  bool next() {
    if (!lines_.next(line_)) return false;
    files::split(line_, ',', fields_);
    return true;
  }

  std::string_view text(std::string_view name) const {
    const auto at = static_cast<std::size_t>(std::find(names_.begin(), names_.end(), name) - names_.begin());
    if (at >= fields_.size()) refuse("lacks the column '" + std::string(name) + "'");
    return fields_[at];
  }

  double number(std::string_view name) const {
    const auto number = files::number_from(text(name));
    if (!number) refuse("has '" + std::string(text(name)) + "' for " + std::string(name) + "; expected a number");
    return *number;
  }

  std::int64_t nanoseconds(std::string_view name, std::int64_t unit_ns) const {
    const auto ns = files::exact_nanoseconds(text(name), unit_ns);
    if (!ns) refuse("has '" + std::string(text(name)) + "' for " + std::string(name) + "; expected a time");
    return *ns;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw files::ReadError(lines_.path() + ": line " + std::to_string(lines_.number()) + ": " + why);
  }

  files::TextLines lines_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::vector<std::string> names_;
};

}  // namespace

std::vector<SimulatedRange> read_skydel(const std::string& path, const SatelliteId& satellite,
                                        const std::string& rinex) {
  NamedColumns columns(path, "Elapsed Time (ms)");
  std::vector<SimulatedRange> ranges;
  while (columns.next()) {
    ranges.push_back({satellite,
                      rinex,
                      {static_cast<std::uint32_t>(columns.number("GPS Week Number")),
                       columns.nanoseconds("GPS TOW", time::kNsPerSecond)},
                      columns.number("Range (m)"),
                      columns.number("PSR (m)"),
                      columns.number("PSR Change Rate (m/s)")});
  }
  return ranges;
}

}  // namespace inslab::verify
