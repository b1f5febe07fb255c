#include "inslab/formats/recordings/imu_recording.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/recordings/imu_columns.hpp"
#include "inslab/formats/recordings/imu_errors.hpp"
#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::recordings {
namespace {

void read_samples(const mcap::McapReader& log, const ImuRecordingOptions& options, ImuRecordingInfo& info,
                  RegularSamples& regular) {
  const std::string topic = catalog::stream_topic<ImuSample>(options.sensor_number);
  log::for_each_sample<ImuSample>(log, topic, [&](const ImuSample& sample, std::uint64_t number) {
    if (number == 1) info.first_ns = sample.header.gps_time_of_week_ns;
    if (sample.gyro_valid && sample.accel_valid) {
      regular.take({time::to_seconds(sample.header.sim_time_ns), increments_of(sample), number});
    } else {
      ++info.invalid;
    }
    return true;
  });
}

/// The two topics alone, in the order of their log times.
ImuRecordingInfo read_errors(const mcap::McapReader& log, const ImuRecordingOptions& options,
                             const ImuErrors::Begin& begin, const ImuErrors::Take& take) {
  ImuErrors errors(log, options, begin, take);
  const auto samples = log::channels_of(log, catalog::stream_topic<ImuSample>(options.sensor_number),
                                        catalog::WireType<ImuSample>::name);
  std::set<std::uint16_t> both =
      log::channels_of(log, catalog::stream_topic<ImuTruth>(options.sensor_number), catalog::WireType<ImuTruth>::name);
  both.insert(samples.begin(), samples.end());
  const auto add = [&errors](auto sample, const mcap::Message& message) {
    if (wire::decode(message.data, message.size, sample)) errors.add(sample);
    return true;
  };
  log.for_each(
      [&](const mcap::Message& message) {
        return samples.count(message.channel_id) != 0 ? add(ImuSample(), message) : add(ImuTruth(), message);
      },
      mcap::McapReader::Order::LogTime, both);
  return errors.finish();
}

/// The layout of a text: from its line of names, or the seven columns.
struct TextLayout {
  char separator = ',';
  std::size_t fields = 0;
  std::vector<ImuColumn> columns;
};

TextLayout layout_of_names(const std::string& path, std::uint64_t line, const std::vector<std::string_view>& names) {
  TextLayout layout;
  layout.fields = names.size();
  std::array<bool, kImuAxes + 1> seen{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = imu_column_named(names[i], i);
    if (!column) continue;
    bool& taken = seen[static_cast<std::size_t>(column->axis + 1)];
    if (taken) {
      throw files::ReadError(path + ": line " + std::to_string(line) + ": column '" + std::string(names[i]) +
                             "' gives again what another column gives");
    }
    taken = true;
    layout.columns.push_back(*column);
  }
  if (!seen[0] || layout.columns.size() < 2) {
    throw files::ReadError(path + ": line " + std::to_string(line) +
                           ": expected 7 numbers, or names with a time such as time_s and at least one axis such as "
                           "gyro_x_rad_per_s or accel_x_m_per_s2");
  }
  return layout;
}

/// A line that is numbers alone is data, with the names of a comment above it or else of seven columns; any other is a
/// line of names.
TextLayout layout_of(const std::string& path, std::uint64_t number, std::string_view line,
                     const std::string& names_above) {
  std::vector<std::string_view> fields;
  const char separator = line.find(',') != std::string_view::npos ? ',' : ' ';
  files::split(line, separator, fields);
  const bool numbers =
      std::all_of(fields.begin(), fields.end(), [](auto text) { return files::number_from(text).has_value(); });
  TextLayout layout;
  if (numbers && !names_above.empty()) {
    std::vector<std::string_view> names;
    files::split(names_above, ',', names);
    if (names.size() != fields.size()) {
      throw files::ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
                             " columns; the names above it are " + std::to_string(names.size()));
    }
    layout = layout_of_names(path, number, names);
  } else if (numbers) {
    if (fields.size() != 1 + kImuAxes) {
      throw files::ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
                             " columns without names; expected 7: seconds, dtheta x y z rad, dv x y z m/s");
    }
    layout.fields = fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i)
      layout.columns.push_back({i, static_cast<int>(i) - 1, 1.0, false, 1'000'000'000});
  } else {
    layout = layout_of_names(path, number, fields);
  }
  layout.separator = separator;
  return layout;
}

class TextRecording {
 public:
  explicit TextRecording(const std::string& path) : path_(path), lines_(path) {
    if (!next_line()) throw files::ReadError(path + ": is empty; expected samples of an IMU");
    layout_ = layout_of(path, lines_.number(), line_, names_);
    first_is_data_ = files::number_from(field(0)).has_value() && all_numbers();
  }

  const TextLayout& layout() const { return layout_; }
  /// Time of the first sample; of one that was read.
  std::int64_t first_ns() const { return *first_ns_; }

  bool next(RawSample& raw) {
    if (!first_is_data_ && !next_line()) return false;
    first_is_data_ = false;
    files::split(line_, layout_.separator, fields_);
    const std::string place = path_ + ": line " + std::to_string(lines_.number());
    if (fields_.size() != layout_.fields) {
      throw files::ReadError(place + ": has " + std::to_string(fields_.size()) + " columns; expected " +
                             std::to_string(layout_.fields));
    }
    raw.place = lines_.number();
    for (const ImuColumn& column : layout_.columns) {
      if (column.axis < 0) {
        raw.time_s = time_of(place, column);
        continue;
      }
      const auto value = files::number_from(fields_[column.place]);
      if (!value || !std::isfinite(*value)) {
        throw files::ReadError(place + ", column " + std::to_string(column.place + 1) + ": is '" +
                               std::string(fields_[column.place].substr(0, 40)) + "'; expected a finite number");
      }
      raw.values[static_cast<std::size_t>(column.axis)] = *value * column.scale;
    }
    return true;
  }

 private:
  /// The next line that is no comment. Before the first one a comment may have the names of the columns.
  bool next_line() {
    while (lines_.next(line_)) {
      line_ = files::trimmed(line_);
      if (line_.empty()) continue;
      if (line_.front() != '#' && line_.front() != '%') return true;
      if (layout_.fields == 0) names_ = names_in_comment(line_);
    }
    return false;
  }
  /// Empty when the comment is not a list of names with a time and an axis among them.
  static std::string names_in_comment(std::string_view comment) {
    const std::size_t begin = comment.find_first_not_of("#% \t");
    if (begin == std::string_view::npos || comment.find(',') == std::string_view::npos) return "";
    std::vector<std::string_view> names;
    files::split(comment.substr(begin), ',', names);
    bool has_time = false, has_axis = false;
    for (const std::string_view name : names) {
      const auto column = imu_column_named(name, 0);
      if (column) (column->axis < 0 ? has_time : has_axis) = true;
    }
    return has_time && has_axis ? std::string(comment.substr(begin)) : "";
  }
  /// Seconds from the first sample.
  double time_of(const std::string& place, const ImuColumn& column) {
    const auto ns = files::exact_nanoseconds(fields_[column.place], column.unit_ns);
    if (!ns) {
      throw files::ReadError(
          place + ", column " + std::to_string(column.place + 1) + ": is '" +
          std::string(fields_[column.place].substr(0, 40)) + "'; expected a time" +
          (column.unit_ns == 1'000'000'000
               ? " in seconds; milli-, micro- and nanoseconds need a name, such as time_ns, in a line above"
               : ""));
    }
    if (!first_ns_) first_ns_ = *ns;
    return time::to_seconds(*ns - *first_ns_);
  }
  std::string_view field(std::size_t i) {
    files::split(line_, layout_.separator, fields_);
    return fields_[i];
  }
  bool all_numbers() {
    files::split(line_, layout_.separator, fields_);
    return std::all_of(fields_.begin(), fields_.end(), [](auto text) { return files::number_from(text).has_value(); });
  }

  std::string path_;
  files::TextLines lines_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::string names_;  ///< in a comment above the first line; empty: none
  TextLayout layout_;
  bool first_is_data_ = false;
  std::optional<std::int64_t> first_ns_;
};

bool is_mcap(const std::string& path) {
  const files::InputFile file(path);
  constexpr std::uint8_t kMagic[] = {0x89, 'M', 'C', 'A', 'P'};
  if (file.size() < sizeof(kMagic)) return false;
  std::uint8_t head[sizeof(kMagic)];
  file.read(0, head, sizeof(head));
  return std::equal(std::begin(kMagic), std::end(kMagic), std::begin(head));
}

}  // namespace

ImuRecordingInfo read_imu_recording(const std::string& path, const ImuRecordingOptions& options,
                                    const std::function<void(const ImuRecordingInfo&)>& begin,
                                    const std::function<void(const ImuIncrements&)>& sample) {
  ImuRecordingInfo info;
  std::array<bool, kImuAxes> is_rate{};
  if (is_mcap(path)) {
    const mcap::McapReader log(path);
    if (options.minus_truth) return read_errors(log, options, begin, sample);
    info.kind = "log, " + catalog::stream_topic<ImuSample>(options.sensor_number);
    info.has_axis.fill(true);
    RegularSamples regular(path, "sample", options, info, is_rate, begin, sample);
    read_samples(log, options, info, regular);
    regular.finish();
    return info;
  }
  if (options.minus_truth)
    throw files::ReadError(path + ": is no log of ours; only such a log holds the truth beside the IMU");
  TextRecording text(path);
  for (const ImuColumn& column : text.layout().columns) {
    if (column.axis < 0) continue;
    info.has_axis[static_cast<std::size_t>(column.axis)] = true;
    is_rate[static_cast<std::size_t>(column.axis)] = column.is_rate;
  }
  info.kind = "text of " + std::to_string(text.layout().fields) + " columns";
  RegularSamples regular(path, "line", options, info, is_rate, begin, sample);
  RawSample raw;
  while (text.next(raw)) {
    info.first_ns = text.first_ns();
    regular.take(raw);
  }
  regular.finish();
  return info;
}

}  // namespace inslab::recordings
