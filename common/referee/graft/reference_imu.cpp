#include "inslab/referee/graft/reference_imu.hpp"

#include <cmath>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/imu/installation.hpp"
#include "inslab/models/trajectory/row_motion.hpp"
#include "inslab/models/trajectory/smooth_truth.hpp"

namespace inslab::graft {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kWeek = 604'800 * kSecond;

/// Of two times that may be of a week: the difference of less than half of one.
std::int64_t difference_ns(std::int64_t a_ns, std::int64_t b_ns) {
  const std::int64_t difference = (a_ns - b_ns) % kWeek;
  return difference > kWeek / 2 ? difference - kWeek : difference < -kWeek / 2 ? difference + kWeek : difference;
}

}  // namespace

ReferenceImu::ReferenceImu(TrajectoryFile reference, const time::Rate& rate, std::int64_t first_ns, std::size_t count)
    : reference_(std::move(reference)),
      rate_(rate),
      begin_ns_(difference_ns(first_ns, reference_.start.time_of_week_ns) - rate.at(1).count()) {
  if (!reference_.rows.front().rpy) {
    throw files::ReadError(reference_.name + ": has no attitude; a reference needs one in every row");
  }
  const std::int64_t last_ns = reference_.rows.back().time.count() - kSecond;
  while (first_ < count && row_time_ns(first_) < kSecond) ++first_;
  std::size_t end = count;
  while (end > first_ && row_time_ns(end) > last_ns) --end;
  count_ = end - first_;
  constexpr double kLeast = 10.0;
  if (static_cast<double>(count_) * rate_.period_s() >= kLeast) return;
  throw files::ReadError(
      reference_.name + ": covers " + std::to_string(static_cast<double>(count_) * rate_.period_s()) +
      " s of the recording, whose first interval begins " + std::to_string(time::to_seconds(begin_ns_)) +
      " s after its first row; expected 10 s (--time-offset moves the recording)");
}

std::int64_t ReferenceImu::row_time_ns(std::size_t interval_end) const {
  return begin_ns_ + rate_.at(interval_end).count();
}

std::vector<RecordedErrors::Increments> ReferenceImu::increments(const Geometry& geometry) const {
  const nav::Gravity gravity(nav::GravityModel::Normal);
  InstallationProfile profile;
  profile.lever_arm_v_m = geometry.lever_arm_v_m;
  profile.mounting_rpy_deg = geometry.mounting_rpy_rad * units::kDegPerRad;
  const imu::Installation installation(profile, gravity);
  const trajectory::SmoothMotion motion = trajectory::motion_through(reference_, {}, gravity);
  trajectory::SmoothVehicle vehicle(motion, gravity);
  const std::int64_t shift_ns = std::llround(geometry.time_offset_s * static_cast<double>(kSecond));
  if (std::abs(shift_ns) >= kSecond) throw std::out_of_range("the time offset is beyond a second");
  const auto go_to = [&](std::size_t end) {
    const std::int64_t before_ns = vehicle.now().count();
    vehicle.advance(time::Nanoseconds(row_time_ns(end) + shift_ns));
    return trajectory::truth_of(vehicle, vehicle.now() - time::Nanoseconds(before_ns));
  };
  imu::Installation::Instant start = installation.at(go_to(first_));
  std::vector<RecordedErrors::Increments> all;
  all.reserve(count_);
  for (std::size_t k = first_; k < first_ + count_; ++k) {
    const TruthState truth = go_to(k + 1);
    const imu::Installation::Instant end = installation.at(truth);
    const imu::Increments perfect = installation.increments(truth, start, end);
    const auto& theta = perfect.dtheta;
    const auto& v = perfect.dv;
    all.push_back({theta.x(), theta.y(), theta.z(), v.x(), v.y(), v.z()});
    start = end;
  }
  return all;
}

}  // namespace inslab::graft
