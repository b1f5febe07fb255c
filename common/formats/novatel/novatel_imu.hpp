#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "inslab/formats/novatel/novatel_line.hpp"
#include "inslab/formats/novatel/novatel_scale.hpp"
#include "inslab/foundation/files/text_lines.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::novatel {

/// The axes in which a unit counts.
enum class NovatelAxes {
  RightForwardUp,    ///< x_frd = y_raw, y_frd = x_raw, z_frd = -z_raw: the lab report (13)
  ForwardRightDown,  ///< as they are
};

/// One sample of a RAWIMU log: increments over the interval that ends at `time`, in forward-right-down axes.
struct NovatelImuRecord {
  std::uint64_t line = 0;  ///< of the file, from 1
  time::GpsTime time;
  nav::Vector3 dtheta_b;  ///< rad
  nav::Vector3 dv_b;      ///< m/s
  std::uint32_t imu_type = 0;
  std::uint32_t status = 0;  ///< the type's own status word
};

/// A line that was left out.
struct BadLine {
  std::uint64_t line = 0;
  std::string reason;
};

/// Reads the IMU samples of a NovAtel ASCII log, one after the other, in flat memory: RAWIMUSA and RAWIMUSXA with the
/// short header (%), RAWIMUA and RAWIMUXA with the long one (#).
///
/// A sample whose line is damaged (CRC, fields, an unknown IMU type, time that does not increase) is never handed out;
/// it is counted and listed in bad_lines(). Lines of other messages are counted alone.
class NovatelImuReader {
 public:
  struct Options {
    NovatelAxes axes = NovatelAxes::RightForwardUp;
    /// For RAWIMUA and RAWIMUSA, which do not say it; without it their lines are bad. RAWIMUXA and RAWIMUSXA must say
    /// the same.
    std::optional<std::uint32_t> imu_type;
  };
  /// Bad lines beyond these are counted and not listed.
  static constexpr std::size_t kMaxListed = 1000;
  static constexpr std::size_t kMaxOtherMessages = 8;

  /// Throws ReadError when the file cannot be opened, std::invalid_argument for an IMU type that is not known.
  explicit NovatelImuReader(const std::string& path) : NovatelImuReader(path, Options{}) {}
  NovatelImuReader(const std::string& path, const Options& options);

  /// The next good sample; false at the end. Throws ReadError when the file cannot be read or is not text.
  bool next(NovatelImuRecord& record);

  /// Of the lines read so far.
  const std::vector<BadLine>& bad_lines() const { return bad_lines_; }
  std::uint64_t bad_line_count() const { return bad_line_count_; }
  std::uint64_t record_count() const { return record_count_; }
  std::uint64_t other_line_count() const { return other_line_count_; }
  /// Names of the other messages, the first few.
  const std::vector<std::string>& other_messages() const { return other_messages_; }

 private:
  void note_other(std::string_view text);
  /// Both give the reason when they cannot.
  std::optional<std::string> read_line(std::string_view text, NovatelImuRecord& record);
  std::optional<std::string> find_type(bool is_extended, const NovatelImuType*& type) const;

  Options options_;
  files::TextLines lines_;
  NovatelLine parts_;
  std::optional<time::GpsTime> last_time_;
  std::vector<BadLine> bad_lines_;
  std::uint64_t bad_line_count_ = 0;
  std::uint64_t record_count_ = 0;
  std::uint64_t other_line_count_ = 0;
  std::vector<std::string> other_messages_;
};

/// Turns increments into lines of RAWIMUSXA. What a count cannot hold is carried into the next, so the counts of a run
/// add up to its increments within half a count.
class NovatelImuFormatter {
 public:
  /// Throws std::invalid_argument for an IMU type that is not known.
  NovatelImuFormatter(std::uint32_t imu_type, NovatelAxes axes);

  const NovatelImuType& type() const { return type_; }

  /// The line, without its end. Throws std::range_error when a count does not fit 32 bits.
  std::string line(const time::GpsTime& time, const nav::Vector3& dtheta_b, const nav::Vector3& dv_b);

 private:
  NovatelImuType type_;
  NovatelAxes axes_;
  std::array<double, 3> gyro_carry_{};   ///< counts
  std::array<double, 3> accel_carry_{};  ///< counts
};

}  // namespace inslab::novatel
