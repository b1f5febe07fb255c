#include "services/gnss_emulator/model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "samples/profile_rules.hpp"
#include "samples/sensor_site.hpp"

namespace inslab::gnss {
namespace {

template <class Profile>
void check(const Profile& profile) {
  if (const auto broken = violation(profile)) throw std::invalid_argument(broken->path + " " + broken->reason);
  if (profile.target.kind != SensorKind::Gnss) throw std::invalid_argument("target_kind is not gnss");
}

std::array<random::NormalCursor, 3> noise(const GnssModel::Setup& setup, const std::string& quantity) {
  const random::Stream stream(setup.seed, "gnss" + std::to_string(setup.sensor_number) + "/" + quantity);
  return {random::NormalCursor(stream.child(".north/white")), random::NormalCursor(stream.child(".east/white")),
          random::NormalCursor(stream.child(".down/white"))};
}

}  // namespace

GnssModel::GnssModel(const Setup& setup)
    : sensor_number_(setup.sensor_number),
      period_ns_(setup.gnss_rate.multiple_of(setup.truth_rate) * setup.truth_rate.period().count()),
      errors_(setup.errors),
      installation_(setup.installation),
      position_noise_(noise(setup, "position")),
      velocity_noise_(noise(setup, "velocity")) {
  check(setup.errors);
  check(setup.installation);
  for (const Outage& outage : setup.outages) {
    if (!(outage.start_s >= 0.0 && outage.duration_s >= 0.0)) {
      throw std::invalid_argument("an outage of " + std::to_string(outage.duration_s) + " s from " +
                                  std::to_string(outage.start_s) + " s; both must be 0 or more");
    }
    outages_.push_back(
        {time::from_seconds(outage.start_s).count(), time::from_seconds(outage.start_s + outage.duration_s).count()});
  }
}

void GnssModel::apply(const GnssErrorProfile& profile) {
  check(profile);
  errors_ = profile;
}

void GnssModel::apply(const InstallationProfile& profile) {
  check(profile);
  installation_ = profile;
}

void GnssModel::apply(const FaultProfile& profile) {
  check(profile);
  fault_ = profile;
}

bool GnssModel::in_outage(std::int64_t time_ns) const {
  return fault_.outage || std::any_of(outages_.begin(), outages_.end(), [time_ns](const OutageSpan& outage) {
           return outage.start_ns <= time_ns && time_ns < outage.end_ns;
         });
}

Vector3 GnssModel::draw(std::array<random::NormalCursor, 3>& numbers, const Vector3& sigma, std::uint64_t epoch) {
  return {sigma.x() * numbers[0].at(epoch), sigma.y() * numbers[1].at(epoch), sigma.z() * numbers[2].at(epoch)};
}

std::optional<GnssFix> GnssModel::observe(const TruthState& truth) {
  const std::int64_t time_ns = truth.header.sim_time_ns;
  if (time_ns <= 0 || time_ns % period_ns_ != 0 || in_outage(time_ns)) return std::nullopt;
  const auto epoch = static_cast<std::uint64_t>(time_ns / period_ns_);

  const SensorSite antenna = sensor_site(truth, installation_.lever_arm_v_m);
  const Vector3 position_error_ned_m =
      draw(position_noise_, errors_.position_sigma_ned_m, epoch) + fault_.position_jump_ned_m;
  const nav::Geodetic measured = nav::displaced(antenna.position, position_error_ned_m);

  GnssFix fix;
  fix.header = truth.header;
  fix.header.sequence_number = fixes_++;
  fix.header.publish_realtime_ns = 0;
  fix.header.publish_monotonic_ns = 0;
  fix.sensor_number = sensor_number_;
  fix.available_sim_time_ns = time_ns + time::from_seconds(errors_.latency_s).count();
  fix.fix_type = errors_.fix_type;
  fix.latitude_rad = measured.latitude_rad;
  fix.longitude_rad = measured.longitude_rad;
  fix.height_m = measured.height_m;
  fix.v_n = antenna.v_n + draw(velocity_noise_, errors_.velocity_sigma_ned_m_per_s, epoch);
  fix.position_sigma_ned_m = errors_.position_sigma_ned_m;
  fix.velocity_sigma_ned_m_per_s = errors_.velocity_sigma_ned_m_per_s;
  fix.satellites_used = errors_.satellites;
  fix.hdop = errors_.hdop;
  fix.vdop = errors_.vdop;
  fix.pdop = std::hypot(errors_.hdop, errors_.vdop);
  fix.revisions = {errors_.request.journal_number, installation_.request.journal_number, fault_.request.journal_number};
  return fix;
}

}  // namespace inslab::gnss
