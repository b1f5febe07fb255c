#include "inslab/referee/verify/alignment_block.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "inslab/formats/novatel/novatel_imu.hpp"
#include "inslab/foundation/files/text_writer.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/referee/calibrate/recording.hpp"
#include "inslab/referee/verify/catalogue.hpp"

namespace inslab::verify {
namespace {

constexpr double kLatitudeDeg = 30.53;
constexpr double kRateHz = 200.0;

constexpr std::uint32_t kIsa100c = 26;
const nav::RollPitchYaw kAttitude{1.0 / units::kDegPerRad, -2.0 / units::kDegPerRad, 45.0 / units::kDegPerRad};
constexpr std::array<const char*, 3> kNames{"roll", "pitch", "yaw"};
constexpr std::array<double, 3> kLabDeg{0.0854, 0.0866, 13.0122};  ///< standard deviations of a sample

scenario::Trajectory at_rest(int duration_s) {
  scenario::Trajectory trajectory;
  trajectory.initial.latitude_deg = kLatitudeDeg;
  trajectory.initial.longitude_deg = 114.35;
  trajectory.initial.roll_deg = kAttitude.roll_rad * units::kDegPerRad;
  trajectory.initial.pitch_deg = kAttitude.pitch_rad * units::kDegPerRad;
  trajectory.initial.yaw_deg = kAttitude.yaw_rad * units::kDegPerRad;
  scenario::Segment rest;
  rest.duration_s = duration_s;
  trajectory.segments.push_back(rest);
  return trajectory;
}

struct Run {
  calibrate::AlignmentResult direct;
  calibrate::AlignedRecording read_back;
};

/// A file name that is gone with this object.
class PassingPath {
 public:
  PassingPath()
      : path_((std::filesystem::temp_directory_path() / fmt::format("inslab_{}_alignment.asc", getpid())).string()) {}
  PassingPath(const PassingPath&) = delete;
  PassingPath& operator=(const PassingPath&) = delete;
  ~PassingPath() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::string& text() const { return path_; }

 private:
  std::string path_;
};

Run align_run(std::uint64_t seed, const Subjects& subjects, int duration_s) {
  const time::Rate rate(kRateHz);
  const nav::Gravity gravity;
  const auto truth = subjects.truth(at_rest(duration_s), rate);
  const Imu imu = subjects.imu({seed, 0, rate, gravity, catalogue_profile<ImuErrorProfile>("imu/span100c"),
                                VibrationProfile{}, InstallationProfile{}});
  imu(truth->current());
  const nav::Geodetic site{kLatitudeDeg / units::kDegPerRad, 0.0, 0.0};
  calibrate::StaticAlignment direct(rate.period_s(), site.latitude_rad, gravity.g_n(site).norm(), {});
  const PassingPath path;
  const ImuLines line = subjects.lines();
  files::TextWriter file(path.text(), "");
  for (int k = 0; k < static_cast<int>(duration_s * kRateHz); ++k) {
    const ImuSample sample = imu(truth->advance())->sample;
    direct.add(sample.dtheta_b, sample.dv_b);
    file.text(line(sample));
    file.end_line();
  }
  file.close();
  calibrate::RecordingOptions options;
  options.latitude_deg = kLatitudeDeg;
  return {direct.result(), calibrate::align_recording(path.text(), options)};
}

Row ratio_row(const std::string& name, double found_deg, double expected_deg, double limit) {
  const double off = found_deg / expected_deg - 1.0;
  return {{name, fmt::format("{:.4f}", found_deg), fmt::format("{:.4f}", expected_deg),
           fmt::format("{:+.2f} %", 100.0 * off), fmt::format("{:.0f} %", 100.0 * limit)},
          std::abs(off) <= limit};
}

Table spread_table(const calibrate::AlignmentResult& result) {
  Table table{"Standard deviations of static coarse alignment, deg", {"", "found", "expected", "off", "limit"}, {}, {}};
  // The mean of 200 samples is quieter by sqrt(200) in what is linear in the noise. Yaw is not at 13 deg.
  const std::array<double, 3> quieter{std::sqrt(kRateHz), std::sqrt(kRateHz), 14.6};
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double epoch_deg = result.epochs.sigma_rad[i] * units::kDegPerRad;
    table.rows.push_back(ratio_row(fmt::format("{}, per sample", kNames[at]), epoch_deg, kLabDeg[at], 0.05));
    table.rows.push_back(ratio_row(fmt::format("{}, per second", kNames[at]),
                                   result.seconds.sigma_rad[i] * units::kDegPerRad, epoch_deg / quieter[at], 0.08));
  }
  table.notes = {
      "Per sample against the lab report's table; per second against those of the samples over sqrt(200), "
      "for yaw over 14.6."};
  return table;
}

/// Half a count of all the span's increments turns yaw by this, rad: over the horizontal rate of the Earth, and twice
/// that for the tilt's part, which is far smaller.
double yaw_of_a_count_rad(int duration_s) {
  const double horizontal_rad = nav::wgs84::omega_e_rad_per_s * std::cos(kLatitudeDeg / units::kDegPerRad) * duration_s;
  return novatel::find_novatel_imu_type(kIsa100c)->rad_per_count / horizontal_rad;
}

/// Roll and pitch are the mean of the samples' own, whose noise is white: four standard deviations of that mean.
double tilt_limit_deg(double of_a_sample_deg, int duration_s) {
  return 4.0 * of_a_sample_deg / std::sqrt(duration_s * kRateHz);
}

Table whole_table(const Run& run, int duration_s) {
  constexpr double kYawLimitDeg = 0.1;
  const std::array<double, 3> limits_deg{tilt_limit_deg(kLabDeg[0], duration_s), tilt_limit_deg(kLabDeg[1], duration_s),
                                         kYawLimitDeg};
  Table table{
      "Whole span, deg", {"", "truth", "found", "off", "limit", "from RAWIMUSXA lines", "apart", "limit"}, {}, {}};
  if (!run.direct.whole || !run.read_back.alignment.whole) {
    table.notes = {run.direct.refusal + run.read_back.alignment.refusal};
    return table;
  }
  const auto angles = [](const nav::RollPitchYaw& rpy) {
    return std::array<double, 3>{rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad};
  };
  const auto truth = angles(kAttitude), found = angles(*run.direct.whole),
             read = angles(*run.read_back.alignment.whole);
  for (std::size_t i = 0; i < 3; ++i) {
    const double apart = std::abs(nav::wrapped_to_pi(read[i] - found[i]));
    const double off_deg = std::abs(nav::wrapped_to_pi(found[i] - truth[i])) * units::kDegPerRad;
    table.rows.push_back({{kNames[i], fmt::format("{:.4f}", truth[i] * units::kDegPerRad),
                           fmt::format("{:.4f}", found[i] * units::kDegPerRad), fmt::format("{:.1e}", off_deg),
                           fmt::format("{:.1e}", limits_deg[i]), fmt::format("{:.4f}", read[i] * units::kDegPerRad),
                           fmt::format("{:.1e}", apart * units::kDegPerRad),
                           fmt::format("{:.1e}", yaw_of_a_count_rad(duration_s) * units::kDegPerRad)},
                          apart <= yaw_of_a_count_rad(duration_s) && off_deg <= limits_deg[i]});
  }
  table.notes = {
      fmt::format("Yaw within {} deg of the truth, roll and pitch within four standard deviations of the mean of the "
                  "samples. Apart: by no more than a count of the gyro over the whole "
                  "span turns yaw, since the counts of a run add up to its increments within half a count.",
                  kYawLimitDeg),
      fmt::format("{} samples, {} bad lines.", run.read_back.alignment.samples, run.read_back.bad_line_count)};
  if (run.read_back.bad_line_count != 0 || run.read_back.alignment.samples != run.direct.samples) {
    table.rows.push_back({{"lines lost", "", "", "", "", "", "", ""}, false});
  }
  return table;
}

}  // namespace

std::vector<Table> alignment_tables(std::uint64_t seed, const Subjects& subjects, int duration_s) {
  const Run run = align_run(seed, subjects, duration_s);
  return {spread_table(run.direct), whole_table(run, duration_s)};
}

}  // namespace inslab::verify
