#include "inslab/formats/text/imu_recording.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/text/imu_columns.hpp"
#include "inslab/foundation/files/decimal_time.hpp"
#include "inslab/foundation/files/error.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/units/units.hpp"

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
    judge();
    begun_ = true;
    begin_(info_);
    for (const RawSample& raw : waiting_) pass(raw);
    waiting_.clear();
  }

  /// Refuses what cannot be what it is taken for: seconds of which no IMU is that slow, and increments that are rates.
  void judge() const {
    constexpr double kSlowest_s = 10.0, kG = units::kG;
    const std::string remedy =
        "; name the columns in a line above, such as time_ns,gyro_x_rad_per_s,...,accel_z_m_per_s2";
    if (info_.dt_s > kSlowest_s) {
      throw ReadError(path_ + ": has a sample each " + std::to_string(info_.dt_s) +
                      " s if its times are seconds, which no IMU has: they may be milli-, micro- or nanoseconds" +
                      (place_name_ == "line" ? remedy : ""));
    }
    double force[3] = {};
    for (const RawSample& raw : waiting_) {
      for (std::size_t i = 0; i < 3; ++i) force[i] += raw.values[3 + i] / static_cast<double>(waiting_.size());
    }
    const double as_it_is = std::hypot(force[0], force[1], force[2]);
    if (is_rate_[3] || is_rate_[4] || is_rate_[5] || std::abs(as_it_is - kG) > 0.05 * kG) return;
    if (as_it_is / info_.dt_s < 10.0 * kG) return;
    throw ReadError(path_ + ": has a mean of " + std::to_string(as_it_is) +
                    " in its accelerometer columns, which is gravity as a rate, in m/s^2; as increments over " +
                    std::to_string(info_.dt_s) + " s, for which unnamed columns are taken, it would be " +
                    std::to_string(as_it_is / info_.dt_s) + " m/s^2" + remedy);
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
  const std::string topic = catalog::stream_topic<ImuSample>(options.sensor_number);
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
  const std::string truth_topic = catalog::stream_topic<ImuTruth>(options.sensor_number);
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

/// A line that is numbers alone is data, with the names of a comment above it or else of seven columns; any other is a
/// line of names.
TextLayout layout_of(const std::string& path, std::uint64_t number, std::string_view line,
                     const std::string& names_above) {
  std::vector<std::string_view> fields;
  const char separator = line.find(',') != std::string_view::npos ? ',' : ' ';
  split(line, separator, fields);
  const bool numbers =
      std::all_of(fields.begin(), fields.end(), [](auto text) { return number_from(text).has_value(); });
  TextLayout layout;
  if (numbers && !names_above.empty()) {
    std::vector<std::string_view> names;
    split(names_above, ',', names);
    if (names.size() != fields.size()) {
      throw ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
                      " columns; the names above it are " + std::to_string(names.size()));
    }
    layout = layout_of_names(path, number, names);
  } else if (numbers) {
    if (fields.size() != 1 + kImuAxes) {
      throw ReadError(path + ": line " + std::to_string(number) + ": has " + std::to_string(fields.size()) +
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
    if (!next_line()) throw ReadError(path + ": is empty; expected samples of an IMU");
    layout_ = layout_of(path, lines_.number(), line_, names_);
    first_is_data_ = number_from(field(0)).has_value() && all_numbers();
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
    for (const ImuColumn& column : layout_.columns) {
      if (column.axis < 0) {
        raw.time_s = time_of(place, column);
        continue;
      }
      const auto value = number_from(fields_[column.place]);
      if (!value || !std::isfinite(*value)) {
        throw ReadError(place + ", column " + std::to_string(column.place + 1) + ": is '" +
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
      line_ = trimmed(line_);
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
    split(comment.substr(begin), ',', names);
    bool has_time = false, has_axis = false;
    for (const std::string_view name : names) {
      const auto column = imu_column_named(name, 0);
      if (column) (column->axis < 0 ? has_time : has_axis) = true;
    }
    return has_time && has_axis ? std::string(comment.substr(begin)) : "";
  }
  /// Seconds from the first sample.
  double time_of(const std::string& place, const ImuColumn& column) {
    const auto ns = exact_nanoseconds(fields_[column.place], column.unit_ns);
    if (!ns) {
      throw ReadError(place + ", column " + std::to_string(column.place + 1) + ": is '" +
                      std::string(fields_[column.place].substr(0, 40)) + "'; expected a time" +
                      (column.unit_ns == 1'000'000'000
                           ? " in seconds; milli-, micro- and nanoseconds need a name, such as time_ns, in a line above"
                           : ""));
    }
    if (!first_ns_) first_ns_ = *ns;
    return static_cast<double>(*ns - *first_ns_) * 1e-9;
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
  std::string names_;  ///< in a comment above the first line; empty: none
  TextLayout layout_;
  bool first_is_data_ = false;
  std::optional<std::int64_t> first_ns_;
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
    info.kind = "log, " + catalog::stream_topic<ImuSample>(options.sensor_number) +
                (options.minus_truth ? " less its truth" : "");
    info.has_axis.fill(true);
    Regular regular(path, "sample", options, info, is_rate, begin, sample);
    read_log(path, options, info, regular);
    regular.finish();
    return info;
  }
  if (options.minus_truth)
    throw ReadError(path + ": is no log of ours; only such a log holds the truth beside the IMU");
  TextRecording text(path);
  for (const ImuColumn& column : text.layout().columns) {
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
