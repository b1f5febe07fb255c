#include "inslab/formats/recordings/fix_errors_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/input_limits.hpp"
#include "inslab/foundation/files/output_file.hpp"
#include "inslab/foundation/files/text_lines.hpp"

namespace inslab::recordings {
namespace {

constexpr std::string_view kNames =
    "time_s,north_m,east_m,down_m,velocity_north_m_per_s,velocity_east_m_per_s,velocity_down_m_per_s,"
    "sigma_north_m,sigma_east_m,sigma_down_m,sigma_velocity_north_m_per_s,sigma_velocity_east_m_per_s,"
    "sigma_velocity_down_m_per_s,fix_type";
constexpr std::size_t kColumns = 14;
constexpr std::int64_t kNsPerS = 1'000'000'000;

/// The vectors of an epoch in the order of the columns.
template <class Epoch>
auto vectors_of(Epoch& epoch) {
  return std::array{&epoch.position_ned_m, &epoch.velocity_ned_m_per_s, &epoch.position_sigma_ned_m,
                    &epoch.velocity_sigma_ned_m_per_s};
}

RecordedFixErrors::Epoch epoch_of(const std::string& place, const std::vector<std::string_view>& fields) {
  const auto refuse = [&](std::size_t column, const char* expected) -> files::ReadError {
    return files::ReadError(place + ", column " + std::to_string(column + 1) + ": is '" +
                            std::string(fields[column].substr(0, 40)) + "'; expected " + expected);
  };
  RecordedFixErrors::Epoch epoch;
  const auto ns = files::exact_nanoseconds(fields[0], kNsPerS);
  if (!ns) throw refuse(0, "a time in seconds");
  epoch.time = time::Nanoseconds(*ns);
  std::size_t column = 1;
  for (Vector3* vector : vectors_of(epoch)) {
    for (double& value : *vector) {
      const auto number = files::number_from(fields[column]);
      if (!number || !std::isfinite(*number)) throw refuse(column, "a finite number");
      value = *number;
      ++column;
    }
  }
  const auto type = enum_named<FixType>(fields[column]);
  if (!type) throw refuse(column, "single, differential, float or fixed");
  epoch.fix_type = *type;
  return epoch;
}

}  // namespace

time::Nanoseconds usual_interval(const std::vector<RecordedFixErrors::Epoch>& epochs) {
  std::vector<time::Nanoseconds> intervals;
  for (std::size_t i = 1; i < epochs.size(); ++i) intervals.push_back(epochs[i].time - epochs[i - 1].time);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

void write_fix_errors(const std::string& path, const RecordedFixErrors& errors) {
  std::string text = std::string(kNames) + "\n";
  char number[64];
  for (const RecordedFixErrors::Epoch& epoch : errors.epochs) {
    std::snprintf(number, sizeof(number), "%.9f", time::to_seconds(epoch.time));
    text += number;
    for (const Vector3* vector : vectors_of(epoch)) {
      for (const double value : *vector) {
        std::snprintf(number, sizeof(number), ",%.6g", value);
        text += number;
      }
    }
    text += "," + std::string(enum_name(epoch.fix_type)) + "\n";
  }
  files::write_file(path, text);
}

RecordedFixErrors read_fix_errors(const std::string& path) {
  files::TextLines lines(path);
  std::string_view line;
  if (!lines.next(line) || files::trimmed(line) != kNames) {
    throw files::ReadError(path +
                           ": line 1 is not what `inslab graft extract-gnss` writes there: " + std::string(kNames));
  }
  RecordedFixErrors errors;
  std::vector<std::string_view> fields;
  while (lines.next(line)) {
    if (files::trimmed(line).empty()) continue;
    const std::string place = path + ": line " + std::to_string(lines.number());
    files::split(line, ',', fields);
    if (fields.size() != kColumns) {
      throw files::ReadError(place + ": has " + std::to_string(fields.size()) + " columns; expected " +
                             std::to_string(kColumns));
    }
    const RecordedFixErrors::Epoch epoch = epoch_of(place, fields);
    const bool is_first = errors.epochs.empty();
    if (is_first ? epoch.time.count() != 0 : epoch.time <= errors.epochs.back().time) {
      throw files::ReadError(place + (is_first ? ": its time is not 0; times are since the first epoch"
                                               : ": its time is not after the one before"));
    }
    if (errors.epochs.size() == files::kMaxRowsInMemory) {
      throw files::ReadError(place + ": is beyond " + std::to_string(files::kMaxRowsInMemory) + " epochs");
    }
    errors.epochs.push_back(epoch);
  }
  if (errors.epochs.size() < 2) throw files::ReadError(path + ": has fewer than two epochs");
  errors.interval = usual_interval(errors.epochs);
  return errors;
}

}  // namespace inslab::recordings
