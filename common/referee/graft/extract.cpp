#include "inslab/referee/graft/extract.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <utility>

#include "inslab/formats/recordings/recorded_errors_file.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/sha256.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/referee/graft/imu_series.hpp"

namespace inslab::graft {
namespace {

/// Of a moving recording: eight copies of it are in memory while the geometry is fitted.
constexpr std::size_t kMostMoving = 4'000'000;

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string rpy_text(const nav::Vector3& rpy_rad) {
  const nav::Vector3 deg = rpy_rad * units::kDegPerRad;
  return fmt::format("roll {:.4f}, pitch {:.4f}, yaw {:.4f} deg", deg.x(), deg.y(), deg.z());
}

Extracted less_truth(const ExtractOptions& options) {
  Extracted out;
  out.errors = read_imu_series(options.file, options.recording).increments;
  out.notes["method"] = "output less the perfect IMU of the same log";
  out.text = fmt::format("{}: the IMU's output less the perfect IMU of the log\n", options.file);
  return out;
}

Extracted from_rest(const ExtractOptions& options) {
  const ImuSeries series = read_imu_series(options.file, options.recording);
  const auto still = still_errors(series.increments, *options.site);
  if (const auto* refusal = std::get_if<std::string>(&still)) {
    throw files::ReadError(options.file + ": no alignment: " + *refusal);
  }
  Extracted out;
  const auto& found = std::get<StillErrors>(still);
  const nav::RollPitchYaw rpy = nav::rpy_from_matrix(found.C_nb);
  out.errors = found.errors;
  out.notes["method"] = "at rest, less the Earth's rate and gravity by whole-span alignment";
  const std::string attitude = rpy_text({rpy.roll_rad, rpy.pitch_rad, rpy.yaw_rad});
  out.notes["attitude"] = attitude;
  out.text = fmt::format(
      "{}: {}, at rest, less the Earth's rate and gravity at {}\n"
      "Not observable at rest with an attitude from the same means, and not in the errors: the accelerometers' means "
      "level{}\n",
      options.file, series.kind, attitude,
      options.site->feels_the_earth_turn ? ", the gyros' mean east; of the gyros' mean only its part along the Earth's "
                                           "rate is left"
                                         : "");
  return out;
}

std::string geometry_text(const GeometryFit& fit) {
  const Geometry& is = fit.geometry;
  const Geometry& sigma = fit.sigma;
  const nav::Vector3 deg = is.mounting_rpy_rad * units::kDegPerRad;
  const nav::Vector3 sigma_deg = sigma.mounting_rpy_rad * units::kDegPerRad;
  const auto& arm = is.lever_arm_v_m;
  const auto& sigma_arm = sigma.lever_arm_v_m;
  return fmt::format(
      "  time offset  {:.6f} s, sigma {:.2g}: the reference's time at the same instant\n"
      "  mounting     roll {:.4f}, pitch {:.4f}, yaw {:.4f} deg, sigma {:.2g}, {:.2g}, {:.2g}\n"
      "  lever arm    {:.4f}, {:.4f}, {:.4f} m, sigma {:.2g}, {:.2g}, {:.2g}\n",
      is.time_offset_s, sigma.time_offset_s, deg.x(), deg.y(), deg.z(), sigma_deg.x(), sigma_deg.y(), sigma_deg.z(),
      arm.x(), arm.y(), arm.z(), sigma_arm.x(), sigma_arm.y(), sigma_arm.z());
}

/// Share of a signal's power above half of a reference's rate: what means over its intervals leave.
double share_above(const std::vector<RecordedErrors::Increments>& errors, std::size_t axis, std::size_t block) {
  if (block < 2) return 0.0;
  double all = 0.0, left = 0.0, mean = 0.0;
  for (const auto& e : errors) mean += e[axis] / static_cast<double>(errors.size());
  for (std::size_t from = 0; from + block <= errors.size(); from += block) {
    double block_mean = 0.0;
    for (std::size_t k = from; k < from + block; ++k) block_mean += errors[k][axis] / static_cast<double>(block);
    for (std::size_t k = from; k < from + block; ++k) {
      all += (errors[k][axis] - mean) * (errors[k][axis] - mean);
      left += (errors[k][axis] - block_mean) * (errors[k][axis] - block_mean);
    }
  }
  return all > 0.0 ? left / all : 0.0;
}

std::string terms_text(const MotionTerms& terms) {
  std::string text = "  terms of the motion, taken out (share of the variance that they explain)\n";
  for (int axis = 0; axis < 3; ++axis) {
    text += fmt::format(
        "    gyro {}   scale factor {:9.1f} ppm, {:5.1f} %    accel {}   scale factor {:9.1f} ppm, {:5.1f} %\n",
        "xyz"[axis], terms.gyro(axis, axis) / units::kPpm, 100.0 * terms.gyro_explained[axis], "xyz"[axis],
        terms.accel(axis, axis) / units::kPpm, 100.0 * terms.accel_explained[axis]);
  }
  return text;
}

Extracted from_motion(const ExtractOptions& options) {
  const ImuSeries series = read_imu_series(options.file, options.recording);
  trajectory::TrajectoryReading reading = trajectory::read_trajectory(options.reference, options.reference_reading);
  if (!reading.problems.empty()) {
    throw files::ReadError(options.reference +
                           ": is not good enough for a reference; `inslab trajectory check` says why");
  }
  const auto rows = static_cast<double>(reading.file.rows.size());
  const double row_rate_hz = (rows - 1.0) / time::to_seconds(reading.file.rows.back().time);
  // What is given of the offset moves the recording, however much; what is fitted is the rest.
  Geometry start = options.start;
  const time::Nanoseconds given = time::from_seconds(std::exchange(start.time_offset_s, 0.0));
  const ReferenceImu reference(std::move(reading.file), series.increments.rate, series.first_ns + given.count(),
                               series.increments.intervals.size());
  if (reference.count() > kMostMoving) {
    throw files::ReadError(fmt::format("{}: has {} samples along the reference; expected at most {}", options.file,
                                       reference.count(), kMostMoving));
  }
  const auto from = series.increments.intervals.begin() + static_cast<std::ptrdiff_t>(reference.first());
  const std::vector<RecordedErrors::Increments> measured(from, from + static_cast<std::ptrdiff_t>(reference.count()));
  GeometryFit fit;
  fit.geometry = start;
  if (!options.keep_geometry) fit = fit_geometry(reference, measured, start);

  const auto perfect = reference.increments(fit.geometry);
  Extracted out;
  out.errors.rate = series.increments.rate;
  out.errors.intervals.resize(measured.size());
  for (std::size_t k = 0; k < measured.size(); ++k) {
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
      out.errors.intervals[k][axis] = measured[k][axis] - perfect[k][axis];
    }
  }
  const double dt_s = out.errors.rate.period_s();
  out.terms = fit_motion_terms(out.errors.intervals, perfect, dt_s);
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const auto moved = motion_errors(*out.terms, perfect[k], dt_s);
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) out.errors.intervals[k][axis] -= moved[axis];
  }
  fit.geometry.time_offset_s += time::to_seconds(given);
  out.notes["method"] = "in motion, less a reference, less what goes with the motion";
  out.notes["reference"] = name_of(options.reference);
  out.text = fmt::format("{}: {}, {} samples along {}\n{}{}", options.file, series.kind, reference.count(),
                         options.reference, geometry_text(fit), terms_text(*out.terms));
  const auto block = static_cast<std::size_t>(std::floor(out.errors.rate.hz() / row_rate_hz));
  out.text += fmt::format(
      "  above {:.4g} Hz the reference sees nothing: what is there of the signal, {:.0f} % of the power of accel z, is "
      "the vehicle's vibration as well as noise\n",
      0.5 * row_rate_hz, 100.0 * share_above(out.errors.intervals, 5, block));
  return out;
}

}  // namespace

Extracted extract(const ExtractOptions& options) {
  Extracted out = options.recording.minus_truth ? less_truth(options)
                  : options.site                ? from_rest(options)
                                                : from_motion(options);
  out.notes["source"] = name_of(options.file);
  out.notes["source_sha256"] = files::sha256_of_file(options.file);
  return out;
}

ImuErrorProfile profile_of(const std::string& recording_file, const std::optional<MotionTerms>& full) {
  ImuErrorProfile profile;
  profile.name = std::filesystem::path(recording_file).stem().string().substr(0, 64);
  profile.source = full ? "recorded errors with the terms of the motion: inslab graft extract"
                        : "recorded errors alone: inslab graft extract";
  profile.recorded_error.file = name_of(recording_file);
  profile.recorded_error.sha256 = files::sha256_of_file(recording_file);
  if (!full) return profile;
  const auto cross = [](const nav::Matrix3& terms) {  // the order of models/imu/cross_axis.hpp
    Vector6 angles;
    angles << terms(1, 0), terms(2, 0), terms(0, 1), terms(2, 1), terms(0, 2), terms(1, 2);
    return Vector6(angles / units::kArcsec);
  };
  profile.gyro.scale_factor_ppm = full->gyro.diagonal() / units::kPpm;
  profile.gyro.cross_axis_arcsec = cross(full->gyro);
  const nav::Matrix3 by_g = full->g_sensitivity * (units::kG / units::kDegPerH);
  for (int row = 0; row < 3; ++row) profile.gyro.g_sensitivity_deg_per_h_per_g.segment<3>(3 * row) = by_g.row(row);
  profile.accel.scale_factor_ppm = full->accel.diagonal() / units::kPpm;
  profile.accel.cross_axis_arcsec = cross(full->accel);
  profile.accel.nonlinearity_ppm_per_g = full->accel_square * (units::kG / units::kPpm);
  return profile;
}

std::string recording_text(const std::string& recording_file) {
  const recordings::RecordedErrorsFile file = recordings::read_recorded_errors(recording_file);
  const RecordedErrors& errors = file.errors;
  const auto count = static_cast<double>(errors.intervals.size());
  const double dt_s = errors.rate.period_s();
  std::string text = fmt::format("{}: errors of an IMU, {} samples at {} Hz, {:.3f} s\n", recording_file,
                                 errors.intervals.size(), errors.rate.hz(), count * dt_s);
  for (const auto& [key, value] : file.notes) {
    if (key != "rate_hz") text += fmt::format("  {:<14} {}\n", key, value);
  }
  text += fmt::format("  {:<14} {}\n", "sha256", files::sha256_of_file(recording_file));
  text += "  axis             mean            white, if it were white\n";
  for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
    double sum = 0.0, differences = 0.0;
    for (std::size_t k = 0; k < errors.intervals.size(); ++k) {
      sum += errors.intervals[k][axis];
      if (k == 0) continue;
      const double step = errors.intervals[k][axis] - errors.intervals[k - 1][axis];
      differences += 0.5 * step * step;
    }
    const double mean = sum / (count * dt_s);
    const double walk = count > 1.0 ? std::sqrt(differences / (count - 1.0) / dt_s) : 0.0;
    const bool is_gyro = axis < 3;
    text += fmt::format("  {:<12} {:10.4f} {:<8} {:10.5f} {}\n", recordings::kImuAxisNames[axis],
                        mean / (is_gyro ? units::kDegPerH : units::kMGal), is_gyro ? "deg/h" : "mGal",
                        walk / (is_gyro ? units::kDegPerSqrtH : units::kMPerSPerSqrtH),
                        is_gyro ? "deg/sqrt(h)" : "m/s/sqrt(h)");
  }
  return text;
}

}  // namespace inslab::graft
