#include "inslab/referee/calibrate/recording.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

#include "inslab/formats/recordings/imu_recording.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/gravity.hpp"

namespace inslab::calibrate {
namespace {

StaticAlignment alignment(double dt_s, const RecordingOptions& options) {
  const nav::Geodetic site{options.latitude_deg * units::kDeg, 0.0, options.height_m};
  std::optional<double> bias_rad_per_s = options.gyro_bias_deg_per_h;
  if (bias_rad_per_s) *bias_rad_per_s *= units::kDegPerH;
  return StaticAlignment(dt_s, site.latitude_rad, nav::Gravity().g_n(site).norm(), options.limits, bias_rad_per_s);
}

/// Whether the first line is a NovAtel ASCII message. Throws files::ReadError for the abbreviated form.
bool is_novatel(const std::string& path) {
  constexpr std::uint64_t kLooked = 4;
  std::string head;
  const files::InputFile file(path);
  head.resize(static_cast<std::size_t>(std::min(file.size(), kLooked)));
  file.read(0, reinterpret_cast<std::uint8_t*>(head.data()), head.size());
  const bool is_named = head.size() > 1 && head[1] >= 'A' && head[1] <= 'Z';
  if (!is_named || (head[0] != '#' && head[0] != '%' && head[0] != '<')) return false;
  if (head[0] == '<') {
    throw files::ReadError(path +
                           ": line 1 is NovAtel's abbreviated ASCII (<), which has no CRC; expected RAWIMUSXA or "
                           "RAWIMUXA lines");
  }
  files::TextLines lines(path);
  std::string_view line;
  return lines.next(line) && line.find(';') != std::string_view::npos;
}

/// " (INSPVAXA, TIMEA)"
std::string names_of(const std::vector<std::string>& messages) {
  std::string names;
  for (const std::string& name : messages) names += (names.empty() ? " (" : ", ") + name;
  return names.empty() ? "" : names + ")";
}

/// Increments are taken to be of the type's own rate; lost samples lie between others that are not.
void check_rate(const std::string& path, double shortest_s, double dt_s, std::uint32_t imu_type) {
  constexpr double kMostOff = 0.25;
  if (!std::isfinite(shortest_s) || std::abs(shortest_s / dt_s - 1.0) <= kMostOff) return;
  std::ostringstream why;
  why << path << ": samples are " << shortest_s << " s apart at least; expected " << dt_s << " s of IMU type "
      << imu_type;
  throw files::ReadError(why.str());
}

AlignedRecording align_novatel(const std::string& path, const RecordingOptions& options) {
  novatel::NovatelImuReader reader(path, options.novatel);
  novatel::NovatelImuRecord record;
  std::optional<StaticAlignment> sums;
  std::uint32_t imu_type = 0;
  std::uint64_t record_count = 0;
  double shortest_s = std::numeric_limits<double>::infinity();
  time::GpsTime before;
  AlignedRecording aligned;
  while (reader.next(record)) {
    if (sums && record.imu_type != imu_type) {
      throw files::ReadError(path + ": line " + std::to_string(record.line) + " is of IMU type " +
                             std::to_string(record.imu_type) + "; expected " + std::to_string(imu_type) +
                             ", as the lines before it");
    }
    if (!sums) {
      imu_type = record.imu_type;
      aligned.dt_s = 1.0 / novatel::find_novatel_imu_type(record.imu_type)->rate_hz;
      sums = alignment(aligned.dt_s, options);
    }
    if (record_count++ > 0) shortest_s = std::min(shortest_s, time::to_seconds(record.time - before));
    before = record.time;
    sums->add(record.dtheta_b, record.dv_b);
  }
  check_rate(path, shortest_s, aligned.dt_s, imu_type);
  aligned.bad_lines = reader.bad_lines();
  aligned.bad_line_count = reader.bad_line_count();
  if (!sums) {
    std::string why = path + ": no line is a good IMU sample (RAWIMUSA, RAWIMUSXA, RAWIMUA, RAWIMUXA); " +
                      std::to_string(reader.other_line_count()) + " lines are of other messages" +
                      names_of(reader.other_messages()) + ", " + std::to_string(reader.bad_line_count()) + " are bad";
    if (!aligned.bad_lines.empty()) {
      why += ", the first is line " + std::to_string(aligned.bad_lines.front().line) + ": " +
             aligned.bad_lines.front().reason;
    }
    throw files::ReadError(why);
  }
  aligned.alignment = sums->result();
  return aligned;
}

}  // namespace

AlignedRecording align_recording(const std::string& path, const RecordingOptions& options) {
  if (is_novatel(path)) return align_novatel(path, options);
  recordings::ImuRecordingOptions recording;
  recording.sensor_number = options.sensor_number;
  std::optional<StaticAlignment> sums;
  AlignedRecording aligned;
  recordings::read_imu_recording(
      path, recording,
      [&](const recordings::ImuRecordingInfo& info) {
        for (std::size_t axis = 0; axis < recordings::kImuAxes; ++axis) {
          if (!info.has_axis[axis]) {
            throw files::ReadError(path + ": has no " + recordings::kImuAxisNames[axis] +
                                   "; alignment needs all six axes");
          }
        }
        aligned.dt_s = info.dt_s;
        sums = alignment(info.dt_s, options);
      },
      [&](const recordings::ImuIncrements& i) {
        sums->add({i[0], i[1], i[2]}, {i[3], i[4], i[5]});
      });
  aligned.alignment = sums->result();
  return aligned;
}

}  // namespace inslab::calibrate
