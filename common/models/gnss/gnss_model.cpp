#include "inslab/models/gnss/gnss_model.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "inslab/data/catalog/checked_profile.hpp"
#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"

namespace inslab::gnss {
namespace {

/// Where a drift ends: nav::displaced() is good to 1000 km.
constexpr double kLongestDriftM = 1e5;

std::string receiver(std::uint32_t number) { return "gnss" + std::to_string(number); }

random::Stream stream(const GnssModel::Setup& setup, const char* quantity) {
  return {setup.seed, receiver(setup.sensor_number) + "/" + quantity};
}

Vector3 together(const Vector3& a, const Vector3& b) { return (a.cwiseAbs2() + b.cwiseAbs2()).cwiseSqrt(); }

/// Adds what a recording says of the epoch to the fix, whose other position errors are given.
void add(const RecordedFixErrors::Epoch& recorded, const nav::Geodetic& antenna, const Vector3& other_ned_m,
         GnssFix& fix) {
  const nav::Geodetic measured = nav::displaced(antenna, other_ned_m + recorded.position_ned_m);
  fix.latitude_rad = measured.latitude_rad;
  fix.longitude_rad = measured.longitude_rad;
  fix.height_m = measured.height_m;
  fix.v_n += recorded.velocity_ned_m_per_s;
  fix.position_sigma_ned_m = together(fix.position_sigma_ned_m, recorded.position_sigma_ned_m);
  fix.velocity_sigma_ned_m_per_s = together(fix.velocity_sigma_ned_m_per_s, recorded.velocity_sigma_ned_m_per_s);
  fix.fix_type = recorded.fix_type;
}

}  // namespace

GnssModel::GnssModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      rate_(setup.gnss_rate),
      errors_(catalog::checked_for<catalog::Gnss>(setup.errors)),
      installation_(catalog::checked_for<catalog::Gnss>(setup.installation)),
      outages_(setup.outages, setup.outage_areas),
      ladder_(setup.errors, setup.gnss_rate.period_s(), setup.seed, receiver(setup.sensor_number)),
      position_noise_(stream(setup, "position"), random::VectorNoise::kNed, setup.gnss_rate.period_s()),
      velocity_noise_(stream(setup, "velocity"), random::VectorNoise::kNed, setup.gnss_rate.period_s()),
      position_burst_(stream(setup, "position_burst"), random::VectorNoise::kNed, setup.gnss_rate.period_s()),
      recording_run_{setup.seed, receiver(setup.sensor_number), setup.end, setup.recordings},
      recorded_(setup.errors.recorded_error, recording_run_),
      clock_(setup.errors.time_tag, setup.gnss_rate.period_s(), setup.seed, receiver(setup.sensor_number)),
      pulses_(stream(setup, "pps")) {
  pulses_.use(errors_.pps);
  take_errors_of(errors_.lesser_solutions.size());
}

void GnssModel::apply(const GnssErrorProfile& profile) {
  RecordedFixes recorded(profile.recorded_error, recording_run_);
  errors_ = catalog::checked_for<catalog::Gnss>(profile);
  recorded_ = std::move(recorded);
  ladder_.retune(profile, profile.request.continuity);
  clock_.retune(profile.time_tag, profile.request.continuity, epoch_, rate_.at(epoch_).count());
  for (random::VectorNoise* noise : {&position_noise_, &velocity_noise_}) {
    if (profile.request.continuity == Continuity::Reset) noise->reset();
    if (profile.request.continuity == Continuity::Redraw) noise->redraw(epoch_);
  }
  take_errors_of(errors_.lesser_solutions.size());
  pulses_.use(errors_.pps);
}

void GnssModel::apply(const InstallationProfile& profile) {
  installation_ = catalog::checked_for<catalog::Gnss>(profile);
}

void GnssModel::apply(const FaultProfile& profile) {
  fault_ = catalog::checked_for<catalog::Gnss>(profile);
  take_fault();
}

void GnssModel::take_fault() {
  position_burst_.retune(fault_.position_noise_burst_ned_m, Vector3::Zero(), Vector3::Zero());
}

const SolutionErrors& GnssModel::errors_on(std::size_t rung) const {
  if (rung < errors_.lesser_solutions.size()) return errors_.lesser_solutions[rung];
  return errors_;
}

FixType GnssModel::fix_type_on(std::size_t rung) const {
  return rung < errors_.lesser_solutions.size() ? errors_.lesser_solutions[rung].fix_type : errors_.fix_type;
}

void GnssModel::take_errors_of(std::size_t rung) {
  const SolutionErrors& errors = errors_on(rung);
  position_noise_.retune(errors.position_sigma_ned_m, errors.position_gm_sigma_ned_m,
                         errors.position_gm_correlation_time_s);
  velocity_noise_.retune(errors.velocity_sigma_ned_m_per_s, errors.velocity_gm_sigma_ned_m_per_s,
                         errors.velocity_gm_correlation_time_s);
  rung_ = rung;
}

Geometry GnssModel::geometry(const TruthState& truth, const SensorSite& antenna) const {
  if (errors_.satellite_model == SatelliteModel::Stated) return {errors_.satellites, errors_.hdop, errors_.vdop};
  const time::GpsTime time{truth.header.gps_week, truth.header.gps_time_of_week_ns};
  return geometry_of(antenna.position, satellites_e_m(errors_.satellite_model, time),
                     errors_.elevation_mask_deg * units::kDeg);
}

Vector3 GnssModel::drift_ned_m(std::int64_t time_ns) const {
  const std::int64_t begun_ns = std::max<std::int64_t>(0, fault_.request.apply_at_ns);
  const Vector3 drift = fault_.position_drift_ned_m_per_s * (time::to_seconds(time_ns - begun_ns));
  const double length_m = drift.norm();
  return length_m > kLongestDriftM ? drift * (kLongestDriftM / length_m) : drift;
}

GnssRevisions GnssModel::revisions() const {
  return {errors_.request.journal_number, installation_.request.journal_number, fault_.request.journal_number};
}

std::optional<Pulse> GnssModel::pulse(const TruthState& truth) {
  std::optional<Pulse> pulse = pulses_.at(truth, revisions());
  if (pulse) pulse->sample.sensor_number = pulse->truth.sensor_number = sensor_number_;
  return pulse;
}

std::optional<GnssFix> GnssModel::observe(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  if (time_ns <= 0 || !rate_.contains(time::Nanoseconds(time_ns))) return std::nullopt;
  std::optional<GnssFix> fix = fix_of_epoch(truth);
  pulses_.note_epoch(time_ns, fix.has_value());
  return fix;
}

std::optional<GnssFix> GnssModel::fix_of_epoch(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  epoch_ = rate_.index(time::Nanoseconds(time_ns));
  const StreamHeader header = clock_.tagged(truth.header, epoch_);

  const SensorSite antenna = sensor_site(truth, installation_.lever_arm_v_m);
  const Geometry sky = geometry(truth, antenna);
  const bool enough = errors_.satellite_model == SatelliteModel::Stated || sky.satellites >= kFewestSatellites;
  const bool signals = enough && !fault_.outage && !outages_.covers(time_ns, antenna.position);
  const std::optional<std::size_t> rung = ladder_.advance(epoch_, time_ns, signals);
  if (rung && *rung != rung_) take_errors_of(*rung);
  const Vector3 position_noise_ned_m = position_noise_.advance(epoch_);
  const Vector3 velocity_noise_n_m_per_s = velocity_noise_.advance(epoch_);
  if (!rung || fix_type_on(*rung) == FixType::None) return std::nullopt;
  std::optional<RecordedFixErrors::Epoch> recorded;
  if (!recorded_.is_off()) {
    recorded = recorded_.at(time::Nanoseconds(time_ns));
    if (!recorded || recorded->fix_type == FixType::None) return std::nullopt;
  }

  const Vector3 position_fault_ned_m =
      fault_.position_jump_ned_m + drift_ned_m(time_ns) + position_burst_.advance(epoch_);
  const Vector3 velocity_fault_n_m_per_s =
      fault_.velocity_jump_ned_m_per_s +
      (fault_.drift_in_velocity ? fault_.position_drift_ned_m_per_s : Vector3(Vector3::Zero()));
  const nav::Geodetic measured = nav::displaced(antenna.position, position_noise_ned_m + position_fault_ned_m);

  GnssFix fix;
  fix.header = header;
  fix.header.sequence_number = fixes_++;
  fix.header.publish_realtime_ns = 0;
  fix.header.publish_monotonic_ns = 0;
  fix.sensor_number = sensor_number_;
  fix.available_sim_time_ns = time_ns + time::from_seconds(errors_.latency_s).count();
  fix.fix_type = fix_type_on(*rung);
  fix.latitude_rad = measured.latitude_rad;
  fix.longitude_rad = measured.longitude_rad;
  fix.height_m = measured.height_m;
  fix.v_n = antenna.v_n + velocity_noise_n_m_per_s + velocity_fault_n_m_per_s;
  fix.position_sigma_ned_m = errors_on(*rung).position_total_sigma_ned_m();
  fix.velocity_sigma_ned_m_per_s = errors_on(*rung).velocity_total_sigma_ned_m_per_s();
  fix.satellites_used = sky.satellites;
  fix.hdop = sky.hdop;
  fix.vdop = sky.vdop;
  fix.pdop = std::hypot(sky.hdop, sky.vdop);
  fix.revisions = revisions();
  if (recorded) add(*recorded, antenna.position, position_noise_ned_m + position_fault_ned_m, fix);
  if (fault_.wrong_fix_type != FixType::None) fix.fix_type = fault_.wrong_fix_type;
  return fix;
}

}  // namespace inslab::gnss
