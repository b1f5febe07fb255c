#include "inslab/referee/graft/fix_errors.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <filesystem>

#include "inslab/data/catalog/topics.hpp"
#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/data/samples/sensor_site.hpp"
#include "inslab/formats/log/log_topic.hpp"
#include "inslab/formats/recordings/fix_errors_text.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/files/sha256.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_truth.hpp"
#include "inslab/referee/graft/reference_imu.hpp"

namespace inslab::graft {
namespace {

/// A fix and its time in the GPS week.
struct Fix {
  std::int64_t time_ns = 0;
  GnssFix fix;
};

struct Fixes {
  std::vector<Fix> all;
  bool has_velocity = false;
  bool has_claims = false;
};

bool is_log(const std::string& path) { return std::filesystem::path(path).extension() == ".mcap"; }

Fixes fixes_of_log(const FixErrorOptions& options) {
  Fixes fixes;
  fixes.has_velocity = fixes.has_claims = true;
  const mcap::McapReader log(options.file);
  log::for_each_sample<GnssFix>(log, catalog::stream_topic<GnssFix>(options.sensor_number),
                                [&](const GnssFix& fix, auto) {
                                  fixes.all.push_back({fix.header.gps_time_of_week_ns, fix});
                                  return true;
                                });
  return fixes;
}

Fixes fixes_of_text(const FixErrorOptions& options) {
  trajectory::TrajectoryReadOptions reading;
  reading.columns = options.columns;
  const TrajectoryFile file = trajectory::read_trajectory(options.file, reading).file;
  Fixes fixes;
  fixes.has_velocity = file.rows.front().v_n.has_value();
  for (const TrajectoryRow& row : file.rows) {
    Fix fix;
    fix.time_ns = file.start.time_of_week_ns + row.time.count();
    fix.fix.latitude_rad = row.position.latitude_rad;
    fix.fix.longitude_rad = row.position.longitude_rad;
    fix.fix.height_m = row.position.height_m;
    if (row.v_n) fix.fix.v_n = *row.v_n;
    fix.fix.fix_type = options.fix_type;
    fixes.all.push_back(fix);
  }
  return fixes;
}

/// Errors of the fixes against a reference, and how they go with its geometry.
struct Compared {
  std::vector<RecordedFixErrors::Epoch> epochs;  ///< times in the reference's
  std::vector<Vector3> v_n;
  std::vector<Matrix3> C_nv;
};

Compared compared(const TrajectoryFile& reference, const Fixes& fixes, double time_offset_s, const Vector3& arm_v_m) {
  const nav::Gravity gravity;
  const trajectory::SmoothMotion motion = trajectory::motion_through(reference, {}, gravity);
  trajectory::SmoothVehicle vehicle(motion, gravity);
  const std::int64_t shift_ns = time::from_seconds(time_offset_s).count() - reference.start.time_of_week_ns;
  Compared out;
  for (const Fix& fix : fixes.all) {
    const time::Nanoseconds at(fix.time_ns + shift_ns);
    if (at <= vehicle.now() || at >= reference.rows.back().time) continue;
    vehicle.advance(at);
    const TruthState truth = trajectory::truth_of(vehicle, time::Nanoseconds(0));
    const SensorSite antenna = sensor_site(truth, arm_v_m);
    const Vector3 offset_e = nav::ecef_from_geodetic(geodetic_of(fix.fix)) - nav::ecef_from_geodetic(antenna.position);
    RecordedFixErrors::Epoch epoch;
    epoch.time = at;
    epoch.position_ned_m =
        nav::C_en(antenna.position.latitude_rad, antenna.position.longitude_rad).transpose() * offset_e;
    if (fixes.has_velocity) epoch.velocity_ned_m_per_s = fix.fix.v_n - antenna.v_n;
    epoch.position_sigma_ned_m = fix.fix.position_sigma_ned_m;
    epoch.velocity_sigma_ned_m_per_s = fix.fix.velocity_sigma_ned_m_per_s;
    epoch.fix_type = fix.fix.fix_type;
    out.epochs.push_back(epoch);
    out.v_n.push_back(antenna.v_n);
    out.C_nv.push_back(truth.q_nv.toRotationMatrix());
  }
  return out;
}

using Geometry7 = Eigen::Matrix<double, 7, 1>;  ///< time offset, arm x y z, constant error north east down
using Square7 = Eigen::Matrix<double, 7, 7>;

struct ArmFit {
  Geometry7 change;
  Geometry7 sigma;
};

/// The errors that are left are linear in what is still to be added: v_n offset + C_nv arm + constant.
ArmFit fit_arm(const Compared& errors) {
  Square7 square = Square7::Zero();
  Geometry7 right = Geometry7::Zero();
  double squares = 0.0;
  Vector3 mean = Vector3::Zero();
  for (const auto& epoch : errors.epochs) mean += epoch.position_ned_m / static_cast<double>(errors.epochs.size());
  for (std::size_t i = 0; i < errors.epochs.size(); ++i) {
    Eigen::Matrix<double, 3, 7> row;
    row << errors.v_n[i], errors.C_nv[i], Matrix3::Identity();
    square += row.transpose() * row;
    right += row.transpose() * errors.epochs[i].position_ned_m;
    squares += (errors.epochs[i].position_ned_m - mean).squaredNorm();
  }
  const double variance = std::max(squares / (3.0 * static_cast<double>(errors.epochs.size())), 1e-12);
  Geometry7 known;
  known << 0.1, 5.0, 5.0, 5.0, 100.0, 100.0, 100.0;
  square /= variance;
  square.diagonal() += known.cwiseAbs2().cwiseInverse();
  const Eigen::LDLT<Square7> factors(square);
  ArmFit fit;
  fit.change = factors.solve(right / variance);
  fit.sigma = factors.solve(Square7::Identity()).diagonal().cwiseSqrt();
  return fit;
}

/// What errors spread about their means, as the claim of a receiver that made none.
void claim_the_spread(std::vector<RecordedFixErrors::Epoch>& epochs) {
  const auto spread = [&](Vector3 RecordedFixErrors::Epoch::*of) -> Vector3 {
    Vector3 sum = Vector3::Zero(), squares = Vector3::Zero();
    for (const auto& epoch : epochs) {
      sum += epoch.*of;
      squares += (epoch.*of).cwiseAbs2();
    }
    const auto count = static_cast<double>(epochs.size());
    return (squares / count - (sum / count).cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  };
  const Vector3 position = spread(&RecordedFixErrors::Epoch::position_ned_m);
  const Vector3 velocity = spread(&RecordedFixErrors::Epoch::velocity_ned_m_per_s);
  for (auto& epoch : epochs) {
    epoch.position_sigma_ned_m = position;
    epoch.velocity_sigma_ned_m_per_s = velocity;
  }
}

std::string spread_text(const RecordedFixErrors& errors) {
  std::string text =
      fmt::format("  {} epochs in {:.3f} s, one each {:.3f} s where none is missing\n", errors.epochs.size(),
                  time::to_seconds(errors.epochs.back().time), time::to_seconds(errors.interval));
  constexpr const char* kAxes[] = {"north", "east", "down"};
  for (int axis = 0; axis < 3; ++axis) {
    double sum = 0.0, squares = 0.0;
    for (const auto& epoch : errors.epochs) {
      sum += epoch.position_ned_m[axis];
      squares += epoch.position_ned_m[axis] * epoch.position_ned_m[axis];
    }
    const auto count = static_cast<double>(errors.epochs.size());
    const double mean = sum / count;
    text += fmt::format("  {:<6} mean {:9.4f} m, standard deviation {:.4f} m\n", kAxes[axis], mean,
                        std::sqrt(std::max(0.0, squares / count - mean * mean)));
  }
  return text;
}

}  // namespace

FixErrors extract_fix_errors(const FixErrorOptions& options) {
  const Fixes fixes = is_log(options.file) ? fixes_of_log(options) : fixes_of_text(options);
  const TrajectoryFile reference = trajectory::read_trajectory(options.reference, options.reference_reading).file;
  if (!reference.rows.front().rpy) {
    throw files::ReadError(options.reference + ": has no attitude; a reference needs one in every row");
  }
  double time_offset_s = options.time_offset_s;
  Vector3 arm_v_m = options.lever_arm_v_m;
  Compared errors = compared(reference, fixes, time_offset_s, arm_v_m);
  if (errors.epochs.size() < 10) {
    throw files::ReadError(fmt::format("{}: {} of its {} fixes lie within {}; expected 10 (--time-offset moves them)",
                                       options.file, errors.epochs.size(), fixes.all.size(), options.reference));
  }
  FixErrors out;
  if (!options.keep_geometry) {
    ArmFit fit;
    for (int i = 0; i < 3; ++i) {  // the turning of C_nv within the offset is all that is not linear
      fit = fit_arm(errors);
      time_offset_s += fit.change[0];
      arm_v_m += fit.change.segment<3>(1);
      errors = compared(reference, fixes, time_offset_s, arm_v_m);
    }
    out.text = fmt::format(
        "  time offset  {:.4f} s, sigma {:.2g}: the reference's time at the same instant\n"
        "  lever arm    {:.3f}, {:.3f}, {:.3f} m, sigma {:.2g}, {:.2g}, {:.2g}\n",
        time_offset_s, fit.sigma[0], arm_v_m.x(), arm_v_m.y(), arm_v_m.z(), fit.sigma[1], fit.sigma[2], fit.sigma[3]);
  }
  if (!fixes.has_claims) claim_the_spread(errors.epochs);
  const time::Nanoseconds first = errors.epochs.front().time;
  for (auto& epoch : errors.epochs) epoch.time -= first;
  out.errors.epochs = std::move(errors.epochs);
  out.errors.interval = recordings::usual_interval(out.errors.epochs);
  out.text = fmt::format("{}: fixes along {}\n", options.file, options.reference) + out.text + spread_text(out.errors);
  return out;
}

GnssErrorProfile fix_profile_of(const std::string& recording_file) {
  GnssErrorProfile profile;
  const std::filesystem::path path(recording_file);
  profile.name = path.stem().string().substr(0, 64);
  profile.source = "recorded errors: inslab graft extract-gnss";
  profile.fix_type = FixType::Fixed;
  profile.recorded_error.file = path.filename().string();
  profile.recorded_error.sha256 = files::sha256_of_file(recording_file);
  return profile;
}

}  // namespace inslab::graft
