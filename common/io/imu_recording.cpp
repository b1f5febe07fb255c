#include "io/imu_recording.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "io/error.hpp"
#include "io/log_topic.hpp"
#include "io/text_lines.hpp"
#include "samples/units.hpp"
#include "wire/topic_names.hpp"

namespace inslab::io {
namespace {

constexpr std::size_t kSamplesForInterval = 1000;

/// One sample as its source has it; a rate becomes an increment when the interval is known.
struct RawSample {
  double time_s = 0.0;
  ImuIncrements values{};
  std::uint64_t place = 0;  ///< line, or number in the topic
};

/// Holds back the first samples until they tell the interval, then passes everything on and looks for gaps.
class Regular {
 public:
  Regular(std::string path, std::string place_name, const ImuRecordingOptions& options, ImuRecordingInfo& info,
          std::array<bool, kImuAxes> is_rate, const std::function<void(const ImuRecordingInfo&)>& begin,
          const std::function<void(const ImuIncrements&)>& sample)
      : path_(std::move(path)),
        place_name_(std::move(place_name)),
        options_(options),
        info_(info),
        is_rate_(is_rate),
        begin_(begin),
        sample_(sample) {}

  void take(const RawSample& raw) {
    if (!begun_) {
      waiting_.push_back(raw);
      if (waiting_.size() == kSamplesForInterval) flush();
      return;
    }
    pass(raw);
  }

  void finish() {
    if (!begun_) flush();
  }

 private:
  void flush() {
    if (waiting_.size() < 3) {
      throw ReadError(path_ + ": has " + std::to_string(waiting_.size()) + " samples of an IMU; expected at least 3");
    }
    std::vector<double> intervals;
    for (std::size_t i = 1; i < waiting_.size(); ++i) intervals.push_back(waiting_[i].time_s - waiting_[i - 1].time_s);
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    if (!(*middle > 0.0)) throw ReadError(path_ + ": its times do not increase");
    // A time as printed has its own rounding; the mean of those intervals near the median has less of it. What is left
    // near a whole number of nanoseconds is not the sensor's; 300 Hz has a third of one.
    double sum = 0.0, count = 0.0;
    for (const double interval : intervals) {
      if (std::abs(interval - *middle) > 0.5 * *middle) continue;
      sum += interval;
      count += 1.0;
    }
    const double mean_ns = 1e9 * sum / count;
    constexpr double kRounding_ns = 0.02;
    info_.dt_s = 1e-9 * (std::abs(mean_ns - std::round(mean_ns)) < kRounding_ns ? std::round(mean_ns) : mean_ns);
    begun_ = true;
    begin_(info_);
    for (const RawSample& raw : waiting_) pass(raw);
    waiting_.clear();
  }

  void pass(const RawSample& raw) {
    if (last_time_s_) {
      const double interval_s = raw.time_s - *last_time_s_;
      const std::string place = path_ + ": " + place_name_ + " " + std::to_string(raw.place);
      if (!(interval_s > 0.0)) throw ReadError(place + ": its time is not after the one before");
      if (std::abs(interval_s - info_.dt_s) > 0.5 * info_.dt_s) {
        ++info_.gaps;
        if (!options_.over_gaps) {
          throw ReadError(place + ": comes " + std::to_string(interval_s) + " s after the one before; expected " +
                          std::to_string(info_.dt_s) + " s (--over-gaps: go on as though nothing were missing)");
        }
      }
    }
    last_time_s_ = raw.time_s;
    ImuIncrements increments = raw.values;
    for (std::size_t i = 0; i < kImuAxes; ++i) {
      if (is_rate_[i]) increments[i] *= info_.dt_s;
    }
    ++info_.samples;
    sample_(increments);
  }

  std::string path_;
  std::string place_name_;
  const ImuRecordingOptions& options_;
  ImuRecordingInfo& info_;
  std::array<bool, kImuAxes> is_rate_;
  const std::function<void(const ImuRecordingInfo&)>& begin_;
  const std::function<void(const ImuIncrements&)>& sample_;
  bool begun_ = false;
  std::vector<RawSample> waiting_;
  std::optional<double> last_time_s_;
};

template <class Sample>
ImuIncrements increments_of(const Sample& sample) {
  ImuIncrements values{};
  for (int i = 0; i < 3; ++i) {
    values[static_cast<std::size_t>(i)] = sample.dtheta_b[i];
    values[static_cast<std::size_t>(3 + i)] = sample.dv_b[i];
  }
  return values;
}

RawSample raw_of(const ImuSample& sample, std::uint64_t number) {
  return {static_cast<double>(sample.header.sim_time_ns) * 1e-9, increments_of(sample), number};
}

void read_log(const std::string& path, const ImuRecordingOptions& options, ImuRecordingInfo& info, Regular& regular) {
  const McapReader log(path);
  const std::string topic = wire::topic_names::imu(options.sensor_number);
  if (!options.minus_truth) {
    for_each_sample<ImuSample>(log, topic, [&](const ImuSample& sample, std::uint64_t number) {
      if (sample.gyro_valid && sample.accel_valid) {
        regular.take(raw_of(sample, number));
      } else {
        ++info.invalid;
      }
      return true;
    });
    return;
  }
  const std::string truth_topic = wire::topic_names::imu_truth(options.sensor_number);
  const auto samples = channels_of(log, topic, wire::WireType<ImuSample>::name);
  const auto truths = channels_of(log, truth_topic, wire::WireType<ImuTruth>::name);
  if (samples.empty() || truths.empty()) {
    throw ReadError(path + ": has no topics " + topic + " and " + truth_topic + "; it has " + topics_text(log));
  }
  std::set<std::uint16_t> both = samples;
  both.insert(truths.begin(), truths.end());
  // The two topics of an IMU keep no order between each other; what waits for its partner is soon met.
  std::map<std::uint64_t, ImuSample> waiting_samples;
  std::map<std::uint64_t, ImuIncrements> waiting_truths;
  std::uint64_t number = 0;
  const auto pair = [&](const ImuSample& sample, const ImuIncrements& truth) {
    RawSample raw = raw_of(sample, ++number);
    for (std::size_t i = 0; i < kImuAxes; ++i) raw.values[i] -= truth[i];
    if (sample.gyro_valid && sample.accel_valid) {
      regular.take(raw);
    } else {
      ++info.invalid;
    }
  };
  log.for_each(
      [&](const mcap::Message& message) {
        if (samples.count(message.channel_id) != 0) {
          ImuSample sample;
          if (!wire::decode(message.data, message.size, sample)) return true;
          const auto truth = waiting_truths.find(sample.header.sequence_number);
          if (truth == waiting_truths.end()) {
            waiting_samples[sample.header.sequence_number] = sample;
          } else {
            pair(sample, truth->second);
            waiting_truths.erase(truth);
          }
          return true;
        }
        ImuTruth truth;
        if (!wire::decode(message.data, message.size, truth)) return true;
        const auto sample = waiting_samples.find(truth.header.sequence_number);
        if (sample == waiting_samples.end()) {
          waiting_truths[truth.header.sequence_number] = increments_of(truth);
        } else {
          pair(sample->second, increments_of(truth));
          waiting_samples.erase(sample);
        }
        return true;
      },
      McapReader::Order::LogTime, both);
}

/// A column of a CSV that says something of an axis or of the time.
struct CsvColumn {
  std::size_t place = 0;  ///< in the line
  int axis = -1;          ///< below 0: the time
  double scale = 1.0;
  bool is_rate = false;
};

struct NamedQuantity {
  const char* before_axis;
  const char* after_axis;
  bool is_gyro;
  bool is_rate;
  double scale;
};

constexpr NamedQuantity kQuantities[] = {
    {"gyro_", "_rad_per_s", true, true, 1.0},
    {"gyro_", "_deg_per_s", true, true, units::kDegPerS},
    {"gyro_", "_deg_per_h", true, true, units::kDegPerH},
    {"dtheta_", "_rad", true, false, 1.0},
    {"dtheta_", "_deg", true, false, units::kDeg},
    {"dtheta_", "_arcsec", true, false, units::kArcsec},
    {"dtheta_b_rad.", "", true, false, 1.0},
    {"accel_", "_m_per_s2", false, true, 1.0},
    {"accel_", "_g", false, true, units::kG},
    {"accel_", "_mgal", false, true, units::kMGal},
    {"dv_", "_m_per_s", false, false, 1.0},
    {"dv_b_m_per_s.", "", false, false, 1.0},
};

constexpr std::pair<const char*, double> kTimes[] = {
    {"time_s", 1.0}, {"time_ms", 1e-3}, {"time_us", 1e-6}, {"time_ns", 1e-9}, {"header.sim_time_ns", 1e-9}};

std::optional<CsvColumn> column_named(std::string_view name, std::size_t place) {
  for (const auto& [time, scale] : kTimes) {
    if (name == time) return CsvColumn{place, -1, scale, false};
  }
  for (const NamedQuantity& quantity : kQuantities) {
    for (int axis = 0; axis < 3; ++axis) {
      if (name == quantity.before_axis + std::string(1, "xyz"[axis]) + quantity.after_axis) {
        return CsvColumn{place, (quantity.is_gyro ? 0 : 3) + axis, quantity.scale, quantity.is_rate};
      }
    }
  }
  return std::nullopt;
}

/// The layout of a text: from its line of names, or the seven columns.
struct TextLayout {
  char separator = ',';
  std::size_t fields = 0;
  std::vector<CsvColumn> columns;
};

TextLayout layout_of_names(const std::string& path, std::uint64_t line, const std::vector<std::string_view>& names) {
  TextLayout layout;
  layout.fields = names.size();
  std::array<bool, kImuAxes + 1> seen{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto column = column_named(names[i], i);
    if (!column) continue;
    bool& taken = seen[static_cast<std::size_t>(column->axis + 1)];
    if (taken) {
      throw ReadError(path + ": line " + std::to_string(line) + ": column '" + std::string(names[i]) +
                      "' gives again what another column gives");
    }
    taken = true;
    layout.columns.push_back(*column);
  }
  if (!seen[0] || layout.columns.size() < 2) {
    throw ReadError(path + ": line " + std::to_string(line) +
                    ": expected 7 numbers, or names with a time such as time_s and at least one axis such as "
                    "gyro_x_rad_per_s or accel_x_m_per_s2");
  }
  return layout;
}

/// Where a line that is numbers alone may be data of seven columns, and any other a line of names.
TextLayout layout_of(const std::string& path, std::uint64_t number, std::string_view line) {
  std::vector<std::string_view> fields;
  const char separator = line.find(',') != std::string_view::npos ? ',' : ' ';
  split(line, separator, fields);
  const bool numbers =
      std::all_of(fields.begin(), fields.end(), [](auto text) { return number_from(text).has_value(); });
  TextLayout layout;
  if (numbers) {
    if (fields.size() != 1 + kImuAxes) {
      throw ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
                      " columns without names; expected 7: seconds, dtheta x y z rad, dv x y z m/s");
    }
    layout.fields = fields.size();
    for (std::size_t i = 0; i < fields.size(); ++i) layout.columns.push_back({i, static_cast<int>(i) - 1, 1.0, false});
  } else {
    layout = layout_of_names(path, number, fields);
  }
  layout.separator = separator;
  return layout;
}

class TextRecording {
 public:
  explicit TextRecording(const std::string& path) : path_(path), lines_(path) {
    if (!next_line()) throw ReadError(path + ": is empty; expected samples of an IMU");
    layout_ = layout_of(path, lines_.number(), line_);
    first_is_data_ = number_from(field(0)).has_value() && layout_.fields == 1 + kImuAxes && all_numbers();
  }

  const TextLayout& layout() const { return layout_; }

  bool next(RawSample& raw) {
    if (!first_is_data_ && !next_line()) return false;
    first_is_data_ = false;
    split(line_, layout_.separator, fields_);
    const std::string place = path_ + ": line " + std::to_string(lines_.number());
    if (fields_.size() != layout_.fields) {
      throw ReadError(place + ": has " + std::to_string(fields_.size()) + " columns; expected " +
                      std::to_string(layout_.fields));
    }
    raw.place = lines_.number();
    for (const CsvColumn& column : layout_.columns) {
      const auto value = number_from(fields_[column.place]);
      if (!value || !std::isfinite(*value)) {
        throw ReadError(place + ", column " + std::to_string(column.place + 1) + ": is '" +
                        std::string(fields_[column.place].substr(0, 40)) + "'; expected a finite number");
      }
      if (column.axis < 0) {
        raw.time_s = *value * column.scale;
      } else {
        raw.values[static_cast<std::size_t>(column.axis)] = *value * column.scale;
      }
    }
    return true;
  }

 private:
  bool next_line() {
    while (lines_.next(line_)) {
      line_ = trimmed(line_);
      if (!line_.empty() && line_.front() != '#' && line_.front() != '%') return true;
    }
    return false;
  }
  std::string_view field(std::size_t i) {
    split(line_, layout_.separator, fields_);
    return fields_[i];
  }
  bool all_numbers() {
    split(line_, layout_.separator, fields_);
    return std::all_of(fields_.begin(), fields_.end(), [](auto text) { return number_from(text).has_value(); });
  }

  std::string path_;
  TextLines lines_;
  std::string_view line_;
  std::vector<std::string_view> fields_;
  TextLayout layout_;
  bool first_is_data_ = false;
};

bool is_mcap(const std::string& path) {
  const InputFile file(path);
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
    info.kind =
        "log, " + wire::topic_names::imu(options.sensor_number) + (options.minus_truth ? " less its truth" : "");
    info.has_axis.fill(true);
    Regular regular(path, "sample", options, info, is_rate, begin, sample);
    read_log(path, options, info, regular);
    regular.finish();
    return info;
  }
  if (options.minus_truth)
    throw ReadError(path + ": is no log of ours; only such a log holds the truth beside the IMU");
  TextRecording text(path);
  for (const CsvColumn& column : text.layout().columns) {
    if (column.axis < 0) continue;
    info.has_axis[static_cast<std::size_t>(column.axis)] = true;
    is_rate[static_cast<std::size_t>(column.axis)] = column.is_rate;
  }
  info.kind = "text of " + std::to_string(text.layout().fields) + " columns";
  Regular regular(path, "line", options, info, is_rate, begin, sample);
  RawSample raw;
  while (text.next(raw)) regular.take(raw);
  regular.finish();
  return info;
}

}  // namespace inslab::io
