#include "services/inslab/swap_window.hpp"

#include <algorithm>

#include "nav/geodesy.hpp"
#include "nav/wgs84.hpp"
#include "time/rate.hpp"

namespace inslab::cli {

namespace {

constexpr std::int64_t kLongest_ns = 20'000'000'000;

nav::Geodetic place_of(double latitude_rad, double longitude_rad, double height_m) {
  return {latitude_rad, longitude_rad, height_m};
}

/// Offset of `place` from the vehicle, in ECEF, metres.
Vector3 offset_e(const nav::Geodetic& place, const TruthState& vehicle) {
  return nav::ecef_from_geodetic(place) -
         nav::ecef_from_geodetic(place_of(vehicle.latitude_rad, vehicle.longitude_rad, vehicle.height_m));
}

Matrix3 C_ev(const TruthState& vehicle) {
  return nav::C_en(vehicle.latitude_rad, vehicle.longitude_rad) * vehicle.q_nv.toRotationMatrix();
}

std::uint32_t revision_of(const ImuRevisions& revisions, ProfileKind kind) {
  switch (kind) {
    case ProfileKind::ImuError:
      return revisions.imu_error;
    case ProfileKind::Vibration:
      return revisions.vibration;
    case ProfileKind::Installation:
      return revisions.installation;
    default:
      return revisions.fault;
  }
}

std::uint32_t revision_of(const GnssRevisions& revisions, ProfileKind kind) {
  switch (kind) {
    case ProfileKind::GnssError:
      return revisions.gnss_error;
    case ProfileKind::Installation:
      return revisions.installation;
    default:
      return revisions.fault;
  }
}

template <class Sample>
void note_first(SwapWindows& windows, const Sample& sample) {
  if (windows.first_sequence_seen || revision_of(sample.revisions, windows.ack.kind) != windows.ack.journal_number)
    return;
  windows.first_sequence_seen = sample.header.sequence_number;
}

/// Counts epochs, so that fixes on both sides of an outage are no neighbours.
std::uint64_t epoch_of(const GnssFix& fix, const LogSummary& summary) {
  for (const auto& receiver : summary.scenario.gnss) {
    if (receiver.number != fix.sensor_number) continue;
    return static_cast<std::uint64_t>(fix.header.sim_time_ns / time::Rate(receiver.rate_hz).period().count());
  }
  return fix.header.sequence_number;
}

/// Not one of the profile's lesser solutions, whose sigmas are others.
bool is_at_its_best(const GnssFix& fix, const LogSummary& summary) {
  const AnyProfile* errors =
      summary.in_use(ProfileKind::GnssError, {SensorKind::Gnss, fix.sensor_number}, fix.header.sim_time_ns);
  return errors == nullptr || std::get<GnssErrorProfile>(*errors).fix_type == fix.fix_type;
}

/// From when on the samples of a sensor were made under an entry, its fade included: samples later than this. A sensor
/// slower than the truth takes an entry up at its own next sample, so the ack says it, not the entry's apply time.
std::int64_t in_full_effect_after(const LogSummary& summary, const ProfileInUse& entry) {
  const ProfileRequest& request = request_of(entry.profile);
  std::int64_t after_ns = entry.apply_at_ns;
  for (const ProfileAck& ack : summary.acks) {
    if (ack.journal_number == request.journal_number && ack.target == target_of(entry.profile)) {
      after_ns = ack.first_sample_time_ns - 1;
    }
  }
  return after_ns + time::from_seconds(request.fade_s).count();
}

}  // namespace

std::vector<SwapWindows> cut_windows(const LogSummary& summary) {
  std::vector<SwapWindows> all;
  for (const ProfileAck& ack : summary.acks) {
    if (ack.outcome != AckOutcome::Applied) continue;
    SwapWindows windows;
    windows.ack = ack;
    windows.before.until_ns = ack.first_sample_time_ns - 1;
    windows.before.after_ns = std::max<std::int64_t>(0, windows.before.until_ns - kLongest_ns);
    windows.after.until_ns = time::from_seconds(summary.scenario.duration_s).count();
    for (const ProfileInUse& other : summary.profiles) {
      if (!(target_of(other.profile) == ack.target) || other.apply_at_ns < 0) continue;
      if (request_of(other.profile).journal_number == ack.journal_number) {
        windows.profile = &other.profile;
        windows.after.after_ns = in_full_effect_after(summary, other);
      } else if (other.apply_at_ns < ack.first_sample_time_ns) {
        windows.before.after_ns = std::max(windows.before.after_ns, in_full_effect_after(summary, other));
      } else {
        windows.after.until_ns = std::min(windows.after.until_ns, other.apply_at_ns);
      }
    }
    windows.after.until_ns = std::min(windows.after.until_ns, windows.after.after_ns + kLongest_ns);
    if (windows.profile != nullptr) all.push_back(windows);
  }
  return all;
}

void add_imu(std::vector<SwapWindows>& windows, const ImuSample& sample, const ImuTruth& imu_truth,
             const TruthState& vehicle) {
  const double dt_s = static_cast<double>(sample.interval_ns) * 1e-9;
  const bool delivered = sample.gyro_valid && sample.accel_valid;
  for (SwapWindows& swap : windows) {
    if (!(swap.ack.target == SensorAddress{SensorKind::Imu, sample.sensor_number})) continue;
    note_first(swap, sample);
    for (SwapWindow* window : {&swap.before, &swap.after}) {
      if (!delivered || !window->contains(sample.header.sim_time_ns)) continue;
      const std::uint64_t k = sample.header.sequence_number;
      window->gyro_rad_per_s.add(k, (sample.dtheta_b - imu_truth.dtheta_b) / dt_s);
      window->accel_m_per_s2.add(k, (sample.dv_b - imu_truth.dv_b) / dt_s);
      const auto imu_place = place_of(imu_truth.latitude_rad, imu_truth.longitude_rad, imu_truth.height_m);
      window->imu_arm_v_m.add(k, C_ev(vehicle).transpose() * offset_e(imu_place, vehicle));
    }
  }
}

void add_fix(std::vector<SwapWindows>& windows, const GnssFix& fix, const TruthState& vehicle,
             const LogSummary& summary) {
  const SensorAddress receiver{SensorKind::Gnss, fix.sensor_number};
  const std::uint64_t k = epoch_of(fix, summary);
  for (SwapWindows& swap : windows) {
    if (!(swap.ack.target == receiver)) continue;
    note_first(swap, fix);
    for (SwapWindow* window : {&swap.before, &swap.after}) {
      if (!window->contains(fix.header.sim_time_ns) || !is_at_its_best(fix, summary)) continue;
      const AnyProfile* installed = summary.in_use(ProfileKind::Installation, receiver, fix.header.sim_time_ns);
      const Vector3 arm_v = installed ? std::get<InstallationProfile>(*installed).lever_arm_v_m : Vector3::Zero();
      const nav::Geodetic place = place_of(fix.latitude_rad, fix.longitude_rad, fix.height_m);
      const Matrix3 C_en = nav::C_en(fix.latitude_rad, fix.longitude_rad);
      const Vector3 offset = offset_e(place, vehicle);
      const Vector3 omega_ie_v = C_ev(vehicle).transpose() * Vector3(0.0, 0.0, nav::wgs84::omega_e_rad_per_s);
      const Vector3 v_e = C_ev(vehicle) * (vehicle.q_nv.toRotationMatrix().transpose() * vehicle.v_n +
                                           (vehicle.omega_iv_v - omega_ie_v).cross(arm_v));
      window->antenna_arm_v_m.add(k, C_ev(vehicle).transpose() * offset);
      window->position_ned_m.add(k, C_en.transpose() * (offset - C_ev(vehicle) * arm_v));
      window->velocity_ned_m_per_s.add(k, fix.v_n - C_en.transpose() * v_e);
    }
  }
}

}  // namespace inslab::cli
