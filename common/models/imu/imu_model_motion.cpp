#include <algorithm>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/models/imu/imu_model.hpp"
#include "inslab/models/imu/motion_response.hpp"
#include "inslab/models/imu/mount_motion.hpp"

/// What the triads of an IMU feel of the motion: late, at places of their own, through filters.
namespace inslab::imu {

/// What the triads feel of the motion up to `truth`, for filters, delays and the size effect.
void ImuModel::follow_motion(const TruthState& truth, const Installation::Instant& end, const Increments& perfect) {
  if (vibration_.mount_moves()) {
    follow_mounted(truth, end, perfect);
    return;
  }
  const std::int64_t from_ns = previous_->header.sim_time_ns, to_ns = truth.header.sim_time_ns;
  const double dt_s = time::to_seconds(truth.interval_ns);
  MotionPiece piece = motion_piece(installation_, *previous_, truth, start_, end, perfect);
  if (!size_effect_.is_off()) {
    size_effect_dv_ += size_effect_.increment(piece.omega, piece.rate_jump, dt_s);
    piece = with_size_effect(piece, size_effect_, dt_s);
  }
  gyro_motion_.add(bandwidths_.gyro, {from_ns, to_ns, piece.omega, Vector3::Zero()});
  accel_motion_.add(bandwidths_.accel, {from_ns, to_ns, piece.f, piece.impulse});
}

/// The same on a moving mount, of which filters see the means over the truth's intervals; they are cut where the window
/// of a late triad begins and ends.
void ImuModel::follow_mounted(const TruthState& truth, const Installation::Instant& end, const Increments& perfect) {
  const std::int64_t from_ns = previous_->header.sim_time_ns, to_ns = truth.header.sim_time_ns;
  const MountedInterval mounted(installation_, *previous_, truth, start_, end, vibration_);
  const auto add = [&](const Increments& felt, std::int64_t part_from_ns, std::int64_t part_to_ns) {
    const double dt_s = time::to_seconds(part_to_ns - part_from_ns);
    const auto mean = [dt_s](const Vector3& increment) {
      return Course{increment / dt_s, Vector3::Zero(), Vector3::Zero()};
    };
    gyro_motion_.add(bandwidths_.gyro, {part_from_ns, part_to_ns, mean(felt.dtheta), Vector3::Zero()});
    accel_motion_.add(bandwidths_.accel, {part_from_ns, part_to_ns, mean(felt.dv), Vector3::Zero()});
  };
  const bool is_wide = !size_effect_.is_off();
  if (is_wide) size_effect_dv_ += mounted.size_effect(size_effect_);
  const std::int64_t delay_ns = std::max(gyro_motion_.delay_ns(), accel_motion_.delay_ns());
  if (delay_ns == 0) {
    Increments felt = perfect;
    if (is_wide) felt.dv += mounted.size_effect(size_effect_);
    add(felt, from_ns, to_ns);
    return;
  }
  std::uint64_t k = rate_.index(time::Nanoseconds(from_ns));
  for (std::int64_t a_ns = from_ns, b_ns = from_ns; a_ns < to_ns; a_ns = b_ns) {
    while ((b_ns = rate_.at(k).count() - delay_ns) <= a_ns) ++k;
    b_ns = std::min(b_ns, to_ns);
    const auto part = [&](std::int64_t t_ns) {
      return static_cast<double>(t_ns - from_ns) / static_cast<double>(truth.interval_ns);
    };
    Increments felt = mounted.increments(part(a_ns), part(b_ns));
    if (is_wide) felt.dv += mounted.size_effect(size_effect_, part(a_ns), part(b_ns));
    add(felt, a_ns, b_ns);
  }
}

/// What the triads felt of the motion over the interval that ends.
Increments ImuModel::felt_motion() {
  Increments felt = perfect_;
  if (!is_followed_) return felt;
  gyro_motion_.end(bandwidths_.gyro, from_ns_, to_ns_);
  accel_motion_.end(bandwidths_.accel, from_ns_, to_ns_);
  felt.dv += size_effect_dv_;
  if (gyro_motion_.is_late()) felt.dtheta = gyro_motion_.late();
  if (accel_motion_.is_late()) felt.dv = accel_motion_.late();
  return felt;
}

}  // namespace inslab::imu
