#include "inslab/formats/novatel/novatel_imu.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::novatel {

namespace {

constexpr std::size_t kCounts = 6;
constexpr std::size_t kExtension = 2;     // info bits and IMU type of the extended messages
constexpr std::size_t kBeforeCounts = 3;  // week, seconds, status
constexpr std::size_t kLongHeader = 9;    // port, sequence, idle, time status, week, seconds, status, reserved, version
constexpr std::size_t kShortHeader = 2;   // week, seconds

/// The message begins like one of ours, damaged or not.
bool is_imu_line(std::string_view text) {
  for (const std::string_view beginning : {"%RAWIMU", "#RAWIMU"}) {
    if (text.substr(0, beginning.size()) == beginning) return true;
  }
  return false;
}

const NovatelImuType& known_type(std::uint32_t type) {
  const NovatelImuType* found = find_novatel_imu_type(type);
  if (found == nullptr) throw std::invalid_argument("IMU type " + std::to_string(type) + " is not known");
  return *found;
}

/// Takes raw to forward-right-down coordinates and back: it is its own inverse.
nav::Vector3 turned(const nav::Vector3& v, NovatelAxes axes) {
  if (axes == NovatelAxes::ForwardRightDown) return v;
  return {v.y(), v.x(), -v.z()};
}

std::string fixed(double value, int decimals) {
  std::array<char, 352> text{};
  return {text.data(),
          std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr};
}

/// Week and seconds, the seconds as nanoseconds of a week.
std::optional<time::GpsTime> gps_time(std::string_view week, std::string_view seconds) {
  const auto week_number = files::integer_from(week);
  const auto in_week = files::number_from(seconds);
  if (!week_number || *week_number < 0 || *week_number > 10000) return std::nullopt;
  if (!in_week || !(*in_week >= 0.0 && *in_week <= 604800.0)) return std::nullopt;
  return time::GpsTime{static_cast<std::uint32_t>(*week_number), 0} + time::from_seconds(*in_week);
}

std::optional<std::int64_t> count_from(std::string_view text) {
  const auto count = files::integer_from(text);
  if (!count || *count < std::numeric_limits<std::int32_t>::min() ||
      *count > std::numeric_limits<std::int32_t>::max()) {
    return std::nullopt;
  }
  return count;
}

/// Why the message is none of the four, or has not their numbers of fields.
std::optional<std::string> shape_problem(const NovatelLine& line, bool& is_extended) {
  const std::string plain = line.is_short ? "RAWIMUSA" : "RAWIMUA";
  const std::string extended = line.is_short ? "RAWIMUSXA" : "RAWIMUXA";
  is_extended = line.name == extended;
  if (!is_extended && line.name != plain) {
    return "is named '" + std::string(line.name.substr(0, 20)) + "'; expected " + plain + " or " + extended;
  }
  const std::size_t header = line.is_short ? kShortHeader : kLongHeader;
  if (line.header.size() != header) {
    return "has " + std::to_string(line.header.size()) + " header fields; expected " + std::to_string(header);
  }
  const std::size_t body = (is_extended ? kExtension : 0) + kBeforeCounts + kCounts;
  if (line.body.size() != body) {
    return "has " + std::to_string(line.body.size()) + " fields; expected " + std::to_string(body);
  }
  return std::nullopt;
}

std::int32_t next_count(double value, double& carry) {
  carry += value;
  const double count = std::round(carry);
  if (!(std::abs(count) <= std::numeric_limits<std::int32_t>::max())) {
    throw std::range_error("an increment of " + fixed(value, 0) + " counts does not fit 32 bits");
  }
  carry -= count;
  return static_cast<std::int32_t>(count);
}

}  // namespace

NovatelImuReader::NovatelImuReader(const std::string& path, const Options& options) : options_(options), lines_(path) {
  if (options_.imu_type) (void)known_type(*options_.imu_type);
}

bool NovatelImuReader::next(NovatelImuRecord& record) {
  std::string_view text;
  while (lines_.next(text)) {
    text = files::trimmed(text);
    if (text.empty()) continue;
    if (!is_imu_line(text)) {
      note_other(text);
      continue;
    }
    auto reason = read_line(text, record);
    if (!reason) {
      record.line = lines_.number();
      last_time_ = record.time;
      ++record_count_;
      return true;
    }
    ++bad_line_count_;
    if (bad_lines_.size() < kMaxListed) bad_lines_.push_back({lines_.number(), std::move(*reason)});
  }
  return false;
}

/// A log may be hours of them: a name is looked at only while there is room for it.
void NovatelImuReader::note_other(std::string_view text) {
  ++other_line_count_;
  if (other_messages_.size() >= kMaxOtherMessages || (text.front() != '#' && text.front() != '%')) return;
  const std::string name(text.substr(1, std::min<std::size_t>(text.find_first_of(",;") - 1, 20)));
  if (std::find(other_messages_.begin(), other_messages_.end(), name) == other_messages_.end()) {
    other_messages_.push_back(name);
  }
}

std::optional<std::string> NovatelImuReader::read_line(std::string_view text, NovatelImuRecord& record) {
  if (auto reason = split_novatel(text, parts_)) return reason;
  bool is_extended = false;
  if (auto reason = shape_problem(parts_, is_extended)) return reason;
  const NovatelImuType* type = nullptr;
  if (auto reason = find_type(is_extended, type)) return reason;

  const std::size_t week = is_extended ? kExtension : 0;
  const auto time = gps_time(parts_.body[week], parts_.body[week + 1]);
  if (!time) return "has no GPS week and seconds of week";
  if (last_time_ && (*time - *last_time_).count() <= 0) return "is not later than the sample before";
  const auto status = files::hex_from(parts_.body[week + 2]);
  if (!status) return "has no status word of hexadecimal digits";
  std::array<double, kCounts> counts{};
  for (std::size_t i = 0; i < kCounts; ++i) {
    const auto count = count_from(parts_.body[week + kBeforeCounts + i]);
    if (!count) {
      return "has '" + std::string(parts_.body[week + kBeforeCounts + i].substr(0, 20)) +
             "' where a count of 32 bits is expected";
    }
    counts[i] = static_cast<double>(*count);
  }
  // The order of the fields: Z, -Y, X of the accelerometers, then of the gyros.
  const nav::Vector3 accel_raw(counts[2], -counts[1], counts[0]);
  const nav::Vector3 gyro_raw(counts[5], -counts[4], counts[3]);
  record.time = *time;
  record.dv_b = turned(accel_raw, options_.axes) * type->m_per_s_per_count;
  record.dtheta_b = turned(gyro_raw, options_.axes) * type->rad_per_count;
  record.imu_type = type->type;
  record.status = *status;
  return std::nullopt;
}

std::optional<std::string> NovatelImuReader::find_type(bool is_extended, const NovatelImuType*& type) const {
  std::optional<std::int64_t> number;
  if (options_.imu_type) number = *options_.imu_type;
  if (is_extended) {
    const auto said = files::integer_from(parts_.body[1]);
    if (!said) return "has no number for the IMU type";
    if (number && *said != *number) {
      return "is of the IMU type " + std::to_string(*said) + "; expected " + std::to_string(*number);
    }
    number = said;
  }
  if (!number) return "does not say the IMU type; expected to be told it";
  if (*number >= 0 && *number <= 255) type = find_novatel_imu_type(static_cast<std::uint32_t>(*number));
  if (type == nullptr) return "is of the IMU type " + std::to_string(*number) + ", which is not known";
  return std::nullopt;
}

NovatelImuFormatter::NovatelImuFormatter(std::uint32_t imu_type, NovatelAxes axes)
    : type_(known_type(imu_type)), axes_(axes) {}

std::string NovatelImuFormatter::line(const time::GpsTime& time, const nav::Vector3& dtheta_b,
                                      const nav::Vector3& dv_b) {
  const nav::Vector3 accel_raw = turned(dv_b, axes_) / type_.m_per_s_per_count;
  const nav::Vector3 gyro_raw = turned(dtheta_b, axes_) / type_.rad_per_count;
  const std::string week = std::to_string(time.week);
  const double in_week = time::to_seconds(time.time_of_week_ns);
  const auto two_digits = [](std::uint32_t number) { return (number < 10 ? "0" : "") + std::to_string(number); };
  std::string text = "RAWIMUSXA," + week + "," + fixed(in_week, 3) + ";00," + two_digits(type_.type) + "," + week +
                     "," + fixed(in_week, 9) + ",00000000";
  const auto put = [&text](const nav::Vector3& raw, std::array<double, 3>& carry) {
    const std::array<double, 3> fields{raw.z(), -raw.y(), raw.x()};
    for (std::size_t i = 0; i < fields.size(); ++i) text += "," + std::to_string(next_count(fields[i], carry[i]));
  };
  put(accel_raw, accel_carry_);
  put(gyro_raw, gyro_carry_);
  return "%" + text + "*" + crc_text(novatel_crc(text));
}

}  // namespace inslab::novatel
