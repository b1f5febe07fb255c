#include "inslab/models/satellites/reference_time.hpp"

#include <cmath>

#include "inslab/data/broadcast/system_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/orbit_constants.hpp"
#include "inslab/models/satellites/orbit_plane.hpp"

namespace inslab::satellites {

namespace {

constexpr double kTurn_rad = 2.0 * units::kPi;

/// start + rate * time in [-pi, pi], though rate * time be many turns: the product's rounding is carried along.
double turned(double start_rad, double rate_rad_per_s, double time_s) {
  const double product = rate_rad_per_s * time_s;
  const double rest = std::fma(rate_rad_per_s, time_s, -product);
  return std::remainder(start_rad + (std::remainder(product, kTurn_rad) + rest), kTurn_rad);
}

/// Weeks of the system that begin between the two.
double weeks_crossed(GnssSystem system, const time::GpsTime& from, const time::GpsTime& to) {
  const time::Nanoseconds behind = broadcast::behind_gps(system);
  return static_cast<double>(std::int64_t{(to + -behind).week} - std::int64_t{(from + -behind).week});
}

/// Turns the plane of a geostationary satellite by what the Earth turns in D: node, inclination and perigee follow.
void turn_plane(KeplerianEphemeris& e, double turned_rad, double from_toes_rad, double to_toes_rad) {
  const double tilt = geostationary_tilt_rad();
  const OrbitPlane before{e.omega0_rad - from_toes_rad, e.i0_rad, e.argument_of_perigee_rad};
  const OrbitPlane plane =
      OrbitPlane::of(rotation_x(tilt) * rotation_z(turned_rad) * rotation_x(-tilt) * before.rotation());
  e.omega0_rad = std::remainder(plane.node_rad + to_toes_rad, kTurn_rad);
  e.i0_rad = plane.inclination_rad;
  e.argument_of_perigee_rad = plane.perigee_rad;
}

std::uint32_t counted_on(std::uint32_t issue, std::int64_t steps, std::int64_t modulus) {
  const std::int64_t counted = (static_cast<std::int64_t>(issue) + steps) % modulus;
  return static_cast<std::uint32_t>(counted < 0 ? counted + modulus : counted);
}

/// IODE is the low octet of IODC (IS-GPS-200, 20.3.4.4); IODnav has ten bits; the ages of BeiDou's data five.
void count_issues(KeplerianEphemeris& e, std::int64_t steps) {
  switch (e.satellite.system) {
    case GnssSystem::Gps:
    case GnssSystem::Qzss:
      e.issue_of_clock = counted_on(e.issue_of_clock, steps, 1024);
      e.issue = e.issue_of_clock & 255U;
      break;
    case GnssSystem::Galileo:
      e.issue = counted_on(e.issue, steps, 1024);
      break;
    default:
      e.issue = counted_on(e.issue, steps, 32);
      e.issue_of_clock = counted_on(e.issue_of_clock, steps, 32);
  }
}

}  // namespace

KeplerianEphemeris held_for_run(const KeplerianEphemeris& ephemeris) {
  KeplerianEphemeris e = ephemeris;
  if (!is_beidou_geostationary(e.satellite)) return e;
  e.omega_dot_rad_per_s = e.i_dot_rad_per_s = 0.0;
  e.cuc_rad = e.cus_rad = e.crc_m = e.crs_m = e.cic_rad = e.cis_rad = 0.0;
  return e;
}

GlonassEphemeris held_for_run(const GlonassEphemeris& ephemeris) {
  GlonassEphemeris e = ephemeris;
  e.lunisolar_e_m_per_s2.setZero();
  return e;
}

KeplerianEphemeris re_referenced(const KeplerianEphemeris& ephemeris, const time::GpsTime& toe) {
  const GnssSystem system = ephemeris.satellite.system;
  const double w = orbit_constants(system).omega_e_rad_per_s;
  const time::Nanoseconds moved = toe - ephemeris.toe;
  const double D_s = time::to_seconds(moved);
  const auto toes_rad = [&](const time::GpsTime& t) {
    return w * time::to_seconds(broadcast::time_of_week_ns(system, t));
  };

  KeplerianEphemeris e = ephemeris;
  e.toe = e.toc = toe;
  e.transmitted = ephemeris.transmitted + moved;
  e.m0_rad = turned(e.m0_rad, mean_motion_rad_per_s(e), D_s);
  if (is_beidou_geostationary(e.satellite)) {
    turn_plane(e, turned(0.0, w, D_s), toes_rad(ephemeris.toe), toes_rad(toe));
  } else {
    constexpr double kWeek_s = 604800.0;
    e.i0_rad += e.i_dot_rad_per_s * D_s;
    e.omega0_rad = turned(turned(e.omega0_rad, e.omega_dot_rad_per_s, D_s), -w,
                          kWeek_s * weeks_crossed(system, ephemeris.toe, toe));
  }
  const double Dc_s = time::to_seconds(toe - ephemeris.toc);
  e.af0_s += Dc_s * (e.af1_s_per_s + Dc_s * e.af2_s_per_s2);
  e.af1_s_per_s += 2.0 * Dc_s * e.af2_s_per_s2;
  count_issues(e, moved / message_period(system));
  return e;
}

GlonassEphemeris re_referenced(GlonassOrbit& orbit, const time::GpsTime& tb) {
  const SatelliteState state = orbit.at(tb);
  GlonassEphemeris e = orbit.ephemeris();
  e.transmitted = e.transmitted + (tb - e.tb);
  e.tb = tb;
  e.r_e_m = state.r_e_m;
  e.v_e_m_per_s = state.v_e_m_per_s;
  e.tau_s = -state.clock_s;
  return e;
}

time::Nanoseconds message_period(GnssSystem system) {
  switch (system) {
    case GnssSystem::Galileo:
      return std::chrono::minutes(10);
    case GnssSystem::BeiDou:
      return std::chrono::hours(1);
    case GnssSystem::Glonass:
      return std::chrono::minutes(30);
    default:
      return std::chrono::hours(2);
  }
}

time::GpsTime reference_time_at(GnssSystem system, const time::GpsTime& gps) {
  const std::int64_t period_ns = message_period(system).count();
  if (system == GnssSystem::Glonass) {
    const std::int64_t utc_ns = time::realtime_from_gps(gps).count();
    return time::gps_from_realtime(time::Nanoseconds(utc_ns - utc_ns % period_ns + period_ns / 2));
  }
  const std::int64_t into_period_ns = broadcast::time_of_week_ns(system, gps) % period_ns;
  const bool is_ahead = system == GnssSystem::Gps || system == GnssSystem::Qzss;
  return gps + time::Nanoseconds((is_ahead ? period_ns : 0) - into_period_ns);
}

}  // namespace inslab::satellites
