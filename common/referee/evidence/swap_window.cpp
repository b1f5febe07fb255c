#include "inslab/referee/evidence/swap_window.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "inslab/data/samples/geodetic_of.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/time/rate.hpp"
#include "inslab/models/heading/baseline.hpp"
#include "inslab/nav/direction.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/referee/evidence/air_data_evidence.hpp"

namespace inslab::evidence {

namespace {

constexpr std::int64_t kLongest_ns = 20'000'000'000;

/// Offset of `place` from the vehicle, in ECEF, metres.
Vector3 offset_e(const nav::Geodetic& place, const TruthState& vehicle) {
  return nav::ecef_from_geodetic(place) - nav::ecef_from_geodetic(geodetic_of(vehicle));
}

Matrix3 C_ev(const TruthState& vehicle) {
  return nav::C_en(vehicle.latitude_rad, vehicle.longitude_rad) * vehicle.q_nv.toRotationMatrix();
}

/// Counts epochs, so that fixes on both sides of an outage are no neighbours.
template <class Kind, class Sample>
std::uint64_t epoch_of(const Sample& sample, const LogSummary& summary) {
  for (const auto& receiver : scenario::sensors_of<Kind>(summary.scenario)) {
    if (receiver.number != sample.sensor_number) continue;
    return time::Rate(receiver.rate_hz).index(time::Nanoseconds(sample.header.sim_time_ns));
  }
  return sample.header.sequence_number;
}

/// Not one of the profile's lesser solutions, whose sigmas are others.
bool is_at_its_best(const GnssFix& fix, const LogSummary& summary) {
  const catalog::AnyProfile* errors =
      summary.in_use(ProfileKind::GnssError, {SensorKind::Gnss, fix.sensor_number}, fix.header.sim_time_ns);
  return errors == nullptr || std::get<GnssErrorProfile>(*errors).fix_type == fix.fix_type;
}

using Sensor = std::pair<SensorKind, std::uint32_t>;

Sensor sensor_of(const SensorAddress& address) { return {address.kind, address.number}; }

/// The journal of one sensor in order of apply times, with from when on its samples were made under each entry.
class SensorJournal {
 public:
  void add(std::uint32_t journal_number, std::int64_t apply_at_ns, std::int64_t in_full_effect_after_ns) {
    entries_.push_back({apply_at_ns, in_full_effect_after_ns, journal_number});
  }

  /// To be called once, after the last add().
  void sort() {
    std::stable_sort(entries_.begin(), entries_.end(),
                     [](const Entry& a, const Entry& b) { return a.apply_at_ns < b.apply_at_ns; });
    Latest latest;
    for (const Entry& entry : entries_) {
      latest.add(entry);
      latest_.push_back(latest);
    }
  }

  /// When the last of the other entries that apply before `t` was in full effect; nothing when there is none.
  std::optional<std::int64_t> others_in_effect_before(std::int64_t t, std::uint32_t journal_number) const {
    const auto count = first_from(t) - entries_.begin();
    return count == 0 ? std::nullopt : latest_[static_cast<std::size_t>(count) - 1].but(journal_number);
  }
  /// When the first of the other entries that apply at `t` or later does.
  std::optional<std::int64_t> others_apply_from(std::int64_t t, std::uint32_t journal_number) const {
    for (auto entry = first_from(t); entry != entries_.end(); ++entry) {
      if (entry->journal_number != journal_number) return entry->apply_at_ns;
    }
    return std::nullopt;
  }

 private:
  struct Entry {
    std::int64_t apply_at_ns;
    std::int64_t in_full_effect_after_ns;
    std::uint32_t journal_number;
  };
  /// The two entries whose full effect came last.
  struct Latest {
    std::optional<Entry> first, second;
    void add(const Entry& entry) {
      if (!first || entry.in_full_effect_after_ns >= first->in_full_effect_after_ns) {
        second = std::exchange(first, entry);
      } else if (!second || entry.in_full_effect_after_ns >= second->in_full_effect_after_ns) {
        second = entry;
      }
    }
    std::optional<std::int64_t> but(std::uint32_t journal_number) const {
      const std::optional<Entry>& entry = first && first->journal_number == journal_number ? second : first;
      return entry ? std::optional(entry->in_full_effect_after_ns) : std::nullopt;
    }
  };

  std::vector<Entry>::const_iterator first_from(std::int64_t t) const {
    return std::lower_bound(entries_.begin(), entries_.end(), t,
                            [](const Entry& entry, std::int64_t time) { return entry.apply_at_ns < time; });
  }

  std::vector<Entry> entries_;
  std::vector<Latest> latest_;  ///< up to each entry
};

/// The journals of all sensors. An entry is in effect from the acknowledged first sample on: a sensor slower than the
/// truth takes it up at its own next sample, so the ack says it, not the entry's apply time; its fade is included.
std::map<Sensor, SensorJournal> journals_of(const LogSummary& summary) {
  std::map<std::pair<Sensor, std::uint32_t>, std::int64_t> first_sample_ns;
  for (const ProfileAck& ack : summary.acks) {
    first_sample_ns[{sensor_of(ack.target), ack.journal_number}] = ack.first_sample_time_ns;
  }
  std::map<Sensor, SensorJournal> journals;
  for (const ProfileInUse& entry : summary.profiles) {
    if (entry.apply_at_ns < 0) continue;
    const ProfileRequest& request = catalog::request_of(entry.profile);
    const Sensor sensor = sensor_of(catalog::target_of(entry.profile));
    const auto acked = first_sample_ns.find({sensor, request.journal_number});
    const std::int64_t after_ns = acked == first_sample_ns.end() ? entry.apply_at_ns : acked->second - 1;
    journals[sensor].add(request.journal_number, entry.apply_at_ns,
                         after_ns + time::from_seconds(request.fade_s).count());
  }
  for (auto& [sensor, journal] : journals) journal.sort();
  return journals;
}

SwapWindows windows_of(const ProfileAck& ack, const ProfileInUse& entry, const SensorJournal& journal,
                       std::int64_t end_ns) {
  SwapWindows windows;
  windows.ack = ack;
  windows.profile = &entry.profile;
  windows.before.until_ns = ack.first_sample_time_ns - 1;
  windows.before.after_ns = std::max<std::int64_t>(
      {0, windows.before.until_ns - kLongest_ns,
       journal.others_in_effect_before(ack.first_sample_time_ns, ack.journal_number).value_or(0)});
  windows.after.after_ns =
      ack.first_sample_time_ns - 1 + time::from_seconds(catalog::request_of(entry.profile).fade_s).count();
  windows.after.until_ns =
      std::min({end_ns, windows.after.after_ns + kLongest_ns,
                journal.others_apply_from(ack.first_sample_time_ns, ack.journal_number).value_or(end_ns)});
  return windows;
}

/// Samples that a window takes: what was at the end of its scale is not noise.
bool is_measured(const ImuSample& sample) {
  return sample.gyro_valid && sample.accel_valid && !sample.gyro_saturated && !sample.accel_saturated;
}

}  // namespace

void SwapWindow::add_tag(std::uint64_t index, const StreamHeader& tagged, const StreamHeader& truth) {
  const time::GpsTime tag{tagged.gps_week, tagged.gps_time_of_week_ns},
      valid{truth.gps_week, truth.gps_time_of_week_ns};
  time_tag.add(index, {time::to_seconds(tag - valid), time::to_seconds(truth.sim_time_ns), 0.0});
}

void SensorFilter::use(const ImuErrorProfile& profile) {
  gyro_.retune(imu::in_si(profile.gyro));
  accel_.retune(imu::in_si(profile.accel));
  if (profile.request.continuity != Continuity::Keep) restart();
}

void SensorFilter::restart() {
  gyro_.restart();
  accel_.restart();
}

MagneticExpectation::MagneticExpectation(const MagnetometerErrorProfile& errors,
                                         const InstallationProfile& installation)
    : response_(magnetometer::response(errors)), currents_nt_(magnetometer::currents_nt(errors)) {
  field_.use(installation);
  field_.use(errors.bodies);
}

SwapWindowsOfLog::SwapWindowsOfLog(const LogSummary& summary) : summary_(summary) {
  const std::map<Sensor, SensorJournal> journals = journals_of(summary);
  std::map<std::tuple<Sensor, ProfileKind, std::uint32_t>, const ProfileInUse*> entries;
  for (const ProfileInUse& entry : summary.profiles) {
    const Sensor sensor = sensor_of(catalog::target_of(entry.profile));
    const std::uint32_t number = catalog::request_of(entry.profile).journal_number;
    if (const auto* errors = std::get_if<ImuErrorProfile>(&entry.profile)) passing_[sensor].errors[number] = errors;
    if (entry.apply_at_ns >= 0) entries[{sensor, catalog::kind_of(entry.profile), number}] = &entry;
  }
  const std::int64_t end_ns = time::from_seconds(summary.scenario.duration_s).count();
  for (const ProfileAck& ack : summary.acks) {
    const Sensor sensor = sensor_of(ack.target);
    const auto entry = entries.find({sensor, ack.kind, ack.journal_number});
    if (ack.outcome != AckOutcome::Applied || entry == entries.end()) continue;
    Passing& passing = passing_[sensor];
    passing.by_revision.emplace(std::pair(ack.kind, ack.journal_number), all_.size());
    passing.windows.push_back(all_.size());
    all_.push_back(windows_of(ack, *entry->second, journals.at(sensor), end_ns));
  }
  for (auto& [sensor, passing] : passing_) {
    std::stable_sort(passing.windows.begin(), passing.windows.end(), [this](std::size_t a, std::size_t b) {
      return all_[a].before.until_ns < all_[b].before.until_ns;
    });
  }
}

/// Neither the begins nor the ends of a sensor's windows go back from one swap to its next.
template <class Use>
void SwapWindowsOfLog::for_each_open(Passing& passing, std::int64_t sim_time_ns, const Use& use) {
  const auto is_behind = [&](const SwapWindows& swap) {
    return std::max(swap.before.until_ns, swap.after.until_ns) < sim_time_ns;
  };
  while (passing.first_open < passing.windows.size() && is_behind(all_[passing.windows[passing.first_open]])) {
    ++passing.first_open;
  }
  for (std::size_t i = passing.first_open; i < passing.windows.size(); ++i) {
    SwapWindows& swap = all_[passing.windows[i]];
    if (swap.before.after_ns >= sim_time_ns) return;
    for (SwapWindow* window : {&swap.before, &swap.after}) {
      if (window->contains(sim_time_ns)) use(*window);
    }
  }
}

template <class Sample>
void SwapWindowsOfLog::note_first(const Passing& passing, const Sample& sample) {
  const auto note = [&](const Field& field, std::uint32_t revision) {
    const auto found = passing.by_revision.find({enum_named<ProfileKind>(field.name).value(), revision});
    if (found == passing.by_revision.end()) return;
    std::optional<std::uint64_t>& seen = all_[found->second].first_sequence_seen;
    if (!seen) seen = sample.header.sequence_number;
  };
  std::decay_t<decltype(sample.revisions)>::fields(sample.revisions, note);
}

SensorFilter& SwapWindowsOfLog::filter_for(Passing& passing, const ImuSample& sample, const ImuTruth& imu_truth) {
  if (!passing.filter) passing.filter.emplace(time::to_seconds(sample.interval_ns));
  if (passing.filter_revision != sample.revisions.imu_error) {
    passing.filter_revision = sample.revisions.imu_error;
    const auto errors = passing.errors.find(sample.revisions.imu_error);
    if (errors != passing.errors.end()) passing.filter->use(*errors->second);
  }
  if (imu_truth.discontinuity) passing.filter->restart();
  return *passing.filter;
}

void SwapWindowsOfLog::add(const ImuSample& sample, const ImuTruth& imu_truth, const TruthState& vehicle) {
  const auto found = passing_.find({SensorKind::Imu, sample.sensor_number});
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  const std::uint64_t k = sample.header.sequence_number;
  note_first(passing, sample);
  SensorFilter& filter = filter_for(passing, sample, imu_truth);
  const Vector3 dtheta = filter.gyro(imu_truth.dtheta_b), dv = filter.accel(imu_truth.dv_b);
  if (!is_measured(sample)) return;
  const double dt_s = time::to_seconds(sample.interval_ns);
  for_each_open(passing, sample.header.sim_time_ns, [&](SwapWindow& window) {
    // Without what a recording of a real IMU has put on top: the profile promises the rest.
    const Vector3 gyro_error = (sample.dtheta_b - dtheta - imu_truth.gyro_error.recorded) / dt_s;
    const Vector3 accel_error = (sample.dv_b - dv - imu_truth.accel_error.recorded) / dt_s;
    window.gyro_rad_per_s.add(k, gyro_error);
    window.accel_m_per_s2.add(k, accel_error);
    const double time_s = time::to_seconds(sample.header.sim_time_ns);
    window.gyro_residual_rad_per_s.add(time_s, gyro_error, dtheta / dt_s, dv / dt_s);
    window.accel_residual_m_per_s2.add(time_s, accel_error, dtheta / dt_s, dv / dt_s);
    const auto imu_place = geodetic_of(imu_truth);
    window.imu_arm_v_m.add(k, C_ev(vehicle).transpose() * offset_e(imu_place, vehicle));
    window.add_tag(k, sample.header, vehicle.header);
  });
}

void SwapWindowsOfLog::add(const GnssFix& fix, const TruthState& vehicle) {
  const SensorAddress receiver{SensorKind::Gnss, fix.sensor_number};
  const auto found = passing_.find(sensor_of(receiver));
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  note_first(passing, fix);
  if (!is_at_its_best(fix, summary_)) return;
  const std::uint64_t k = epoch_of<catalog::Gnss>(fix, summary_);
  for_each_open(passing, fix.header.sim_time_ns, [&](SwapWindow& window) {
    const catalog::AnyProfile* installed = summary_.in_use(ProfileKind::Installation, receiver, fix.header.sim_time_ns);
    const Vector3 arm_v = installed ? std::get<InstallationProfile>(*installed).lever_arm_v_m : Vector3::Zero();
    const nav::Geodetic place = geodetic_of(fix);
    const Matrix3 C_en = nav::C_en(fix.latitude_rad, fix.longitude_rad);
    const Vector3 offset = offset_e(place, vehicle);
    const Vector3 omega_ie_v = C_ev(vehicle).transpose() * Vector3(0.0, 0.0, nav::wgs84::omega_e_rad_per_s);
    const Vector3 v_e = C_ev(vehicle) * (vehicle.q_nv.toRotationMatrix().transpose() * vehicle.v_n +
                                         (vehicle.omega_iv_v - omega_ie_v).cross(arm_v));
    window.antenna_arm_v_m.add(k, C_ev(vehicle).transpose() * offset);
    window.position_ned_m.add(k, C_en.transpose() * (offset - C_ev(vehicle) * arm_v));
    window.velocity_ned_m_per_s.add(k, fix.v_n - C_en.transpose() * v_e);
    window.add_tag(k, fix.header, vehicle.header);
  });
}

void SwapWindowsOfLog::add(const MagneticField& sample, const TruthState& vehicle) {
  const SensorAddress sensor{SensorKind::Magnetometer, sample.sensor_number};
  const auto found = passing_.find(sensor_of(sensor));
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  const std::uint64_t k = sample.header.sequence_number;
  note_first(passing, sample);
  if (sample.saturated) return;
  const std::pair revisions(sample.revisions.magnetometer_error, sample.revisions.installation);
  if (!passing.magnetic || revisions != passing.magnetic_revisions) {
    const std::int64_t now = sample.header.sim_time_ns;
    const catalog::AnyProfile* errors = summary_.in_use(ProfileKind::MagnetometerError, sensor, now);
    const catalog::AnyProfile* installed = summary_.in_use(ProfileKind::Installation, sensor, now);
    passing.magnetic.emplace(errors ? std::get<MagnetometerErrorProfile>(*errors) : MagnetometerErrorProfile{},
                             installed ? std::get<InstallationProfile>(*installed) : InstallationProfile{});
    passing.magnetic_revisions = revisions;
  }
  const Vector3 error_nt = sample.B_b_nt - passing.magnetic->B_b_nt(vehicle);
  for_each_open(passing, sample.header.sim_time_ns, [&](SwapWindow& window) {
    window.magnetic_nt.add(k, error_nt);
    window.add_tag(k, sample.header, vehicle.header);
  });
}

void SwapWindowsOfLog::add(const AirPressure& sample, const TruthState& vehicle) {
  const auto found = passing_.find({SensorKind::Barometer, sample.sensor_number});
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  note_first(passing, sample);
  const double error_pa = sample.pressure_pa - passing.air.pressure_pa(sample, vehicle, summary_);
  if (sample.saturated) return;
  for_each_open(passing, sample.header.sim_time_ns, [&](SwapWindow& window) {
    window.pressure.add(sample.header.sequence_number, {error_pa, sample.pressure_altitude_m, 0.0});
    window.add_tag(sample.header.sequence_number, sample.header, vehicle.header);
  });
}

void SwapWindowsOfLog::add(const WheelTravel& sample, const std::vector<const TruthState*>& way) {
  const auto found = passing_.find({SensorKind::Odometer, sample.sensor_number});
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  note_first(passing, sample);
  const double expected_m = passing.way.distance_m(sample, way, summary_);
  const double error_m = std::copysign(1.0, expected_m) * (sample.distance_m - expected_m);
  for_each_open(passing, sample.header.sim_time_ns, [&](SwapWindow& window) {
    window.way_m.add(sample.header.sequence_number, {error_m, std::abs(expected_m), 0.0});
    if (!way.empty() && way.back()->header.sim_time_ns == sample.header.sim_time_ns) {
      window.add_tag(sample.header.sequence_number, sample.header, way.back()->header);
    }
  });
}

void SwapWindowsOfLog::add(const BaselineHeading& sample, const TruthState& vehicle) {
  const SensorAddress sensor{SensorKind::Heading, sample.sensor_number};
  const auto found = passing_.find(sensor_of(sensor));
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  note_first(passing, sample);
  const std::int64_t now_ns = sample.header.sim_time_ns;
  const auto errors = profile_in_use<HeadingErrorProfile>(summary_, sensor, now_ns);
  const auto arms = profile_in_use<InstallationProfile>(summary_, sensor, now_ns);
  if (sample.fix_type != errors.fix_type) return;
  const SensorSite first = sensor_site(vehicle, arms.lever_arm_v_m);
  const Vector3 baseline_s_m = nav::vector_of({sample.heading_rad, sample.pitch_rad}, sample.baseline_m);
  const Vector3 error_m = baseline_s_m - heading::baseline_s_m(vehicle, first, arms);
  if (errors.wrong_fix_offset_m > 0.0 && error_m.norm() > 0.5 * errors.wrong_fix_offset_m) return;
  const std::uint64_t k = epoch_of<catalog::Heading>(sample, summary_);
  for_each_open(passing, now_ns, [&](SwapWindow& window) {
    window.baseline_ned_m.add(k, error_m);
    window.baseline_v_m.add(k, vehicle.q_nv.conjugate() * (first.C_sn.transpose() * baseline_s_m));
    window.add_tag(k, sample.header, vehicle.header);
  });
}

void SwapWindowsOfLog::add(const Airflow& sample, const AirflowTruth& perfect, const TruthState& vehicle) {
  const SensorAddress sensor{SensorKind::AirData, sample.sensor_number};
  const auto found = passing_.find(sensor_of(sensor));
  if (found == passing_.end()) return;
  Passing& passing = found->second;
  note_first(passing, sample);
  const std::int64_t now_ns = sample.header.sim_time_ns;
  if (sample.saturated || profile_in_use<FaultProfile>(summary_, sensor, now_ns).vanes_frozen) return;
  const auto errors = profile_in_use<AirDataErrorProfile>(summary_, sensor, now_ns);
  for_each_open(passing, now_ns, [&](SwapWindow& window) {
    window.airflow.add(sample.header.sequence_number, left_of_airflow(sample, perfect, errors));
    window.add_tag(sample.header.sequence_number, sample.header, vehicle.header);
  });
}

}  // namespace inslab::evidence
