#include "inslab/scenario/motion_matrix.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

#include "inslab/data/json/config_error.hpp"
#include "inslab/foundation/fields/limits.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/text/shown.hpp"

namespace inslab::scenario {

namespace {

using Numbers = std::array<double, 4>;

/// Which parameters of a motion the third and the fourth column hold; none: the column is 0.
struct Parameters {
  double Motion::*third = nullptr;
  double Motion::*fourth = nullptr;
};

Parameters parameters_of(MotionType type) {
  switch (type) {
    case MotionType::DeltaSpeed:
      return {&Motion::speed_change_m_per_s, nullptr};
    case MotionType::TargetSpeed:
      return {&Motion::final_speed_m_per_s, nullptr};
    case MotionType::ConstantAccel:
      return {&Motion::acceleration_m_per_s2, nullptr};
    case MotionType::SineAccel:
      return {&Motion::amplitude_m_per_s2, &Motion::period_s};
    case MotionType::RampAccel:
      return {&Motion::from_m_per_s2, &Motion::to_m_per_s2};
    case MotionType::Turn:
      return {nullptr, &Motion::angle_deg};
    case MotionType::ConstantRate:
      return {&Motion::rate_deg_per_s, nullptr};
    case MotionType::SineRate:
    case MotionType::CosineRate:
      return {&Motion::period_s, &Motion::amplitude_deg_per_s};
    case MotionType::RampRate:
      return {&Motion::from_deg_per_s, &Motion::to_deg_per_s};
    case MotionType::Uniform:
    case MotionType::Ballistic:
      break;
  }
  return {};
}

/// One line of the file, which says where it is wrong.
class Line {
 public:
  Line(std::string file, std::size_t number) : file_(std::move(file)), number_(number) {}

  Segment segment(std::string_view row) const {
    const Numbers columns = numbers(row);
    Segment segment;
    segment.name = "line " + std::to_string(number_);
    segment.duration_s = columns[1];
    Motion motion;
    motion.type = type(columns[0]);
    const Parameters parameters = parameters_of(motion.type);
    set(motion, parameters.third, columns[2], 3);
    set(motion, parameters.fourth, columns[3], 4);
    if (motion.type != MotionType::Uniform) segment.motions.push_back(motion);
    if (const auto broken = limit_violation(segment)) {
      const std::size_t dot = broken->path.rfind('.');
      fail(broken->rule, broken->path.substr(dot == std::string::npos ? 0 : dot + 1) + " " + broken->reason);
    }
    return segment;
  }

  [[noreturn]] void fail(Rule rule, const std::string& reason) const {
    throw json::Error(file_, {rule, "line " + std::to_string(number_), reason});
  }

 private:
  Numbers numbers(std::string_view row) const {
    Numbers values{};
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
      const std::size_t comma = row.find(',');
      more = comma != std::string_view::npos;
      if (count < values.size()) values[count] = number(row.substr(0, comma), count + 1);
      if (more) row.remove_prefix(comma + 1);
    }
    if (count != values.size()) {
      fail(Rule::MotionMatrix, "has " + std::to_string(count) + " columns; expected type, duration and two parameters");
    }
    return values;
  }

  double number(std::string_view field, std::size_t column) const {
    field = files::trimmed(field);
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
      fail(Rule::MotionMatrix,
           "column " + std::to_string(column) + " is " + text::quoted(field, 40) + "; expected a number");
    }
    return value;
  }

  MotionType type(double number) const {
    const auto whole = static_cast<std::int64_t>(std::clamp(number, -1.0, 1e9));
    const auto found = enum_of_number<MotionType>(whole);
    if (found && static_cast<double>(whole) == number) return *found;
    std::string known;
    for (const auto one : EnumNames<MotionType>::numbers) known += (known.empty() ? "" : ", ") + std::to_string(one);
    fail(Rule::MotionMatrix, "column 1 is " + number_text(number) + "; expected one of the types " + known);
  }

  void set(Motion& motion, double Motion::*parameter, double value, int column) const {
    if (parameter != nullptr) {
      motion.*parameter = value;
    } else if (value != 0.0) {
      fail(Rule::MotionMatrix, "column " + std::to_string(column) + " is " + number_text(value) + "; " +
                                   std::string(enum_name(motion.type)) + " has no parameter there: expected 0");
    }
  }

  std::string file_;
  std::size_t number_;
};

std::vector<Segment> read_segments(const std::string& file) {
  files::TextLines lines(file);
  std::vector<Segment> segments;
  double total_s = 0.0;
  for (std::string_view text; lines.next(text);) {
    const std::string_view row = files::trimmed(text);
    if (row.empty() || row.front() == '#') continue;
    const Line line(file, lines.number());
    segments.push_back(line.segment(row));
    total_s += segments.back().duration_s;
    if (segments.size() > kMaxSegments) {
      line.fail(Rule::BoundedSize, "is one segment too many; expected at most " + std::to_string(kMaxSegments));
    }
    if (!(total_s <= kMaxTrajectoryLength_s)) {
      line.fail(Rule::TrajectoryLength, "brings the segments' total above 1e9 s");
    }
  }
  if (segments.empty()) throw json::Error(file, {Rule::NotEmpty, "", "holds no segment"});
  return segments;
}

/// A reader's message without the file at its beginning, which json::Error names itself.
std::string without_file(const std::string& message, const std::string& file) {
  const std::string prefix = file + ": ";
  return message.rfind(prefix, 0) == 0 ? message.substr(prefix.size()) : message;
}

}  // namespace

std::vector<Segment> read_motion_matrix(const std::filesystem::path& file) {
  try {
    return read_segments(file.string());
  } catch (const files::ReadError& error) {
    throw json::Error(file.string(), {Rule::Readable, "", without_file(error.what(), file.string())});
  }
}

}  // namespace inslab::scenario
