#include "inslab/models/satellites/nominal_constellation.hpp"

#include <cmath>

#include "inslab/data/broadcast/system_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/nominal_slots.hpp"
#include "inslab/models/satellites/orbit_constants.hpp"
#include "inslab/models/satellites/orbit_plane.hpp"
#include "inslab/models/satellites/reference_time.hpp"
#include "inslab/nav/wgs84.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::satellites {

namespace {

constexpr double kFullTurn_rad = 2.0 * units::kPi;

/// A satellite's own numbers, of which each has its place in one stream.
class Drawn {
 public:
  Drawn(std::uint64_t seed, const SatelliteId& satellite) : stream_(seed, "sky/" + name_of(satellite) + "/record") {}

  double within(double limit) { return limit * (2.0 * stream_.uniform(next_++) - 1.0); }
  double between(double least, double most) { return least + (most - least) * stream_.uniform(next_++); }

 private:
  random::Stream stream_;
  std::uint64_t next_ = 0;
};

/// A slot at an instant: where its node is on the Earth, and how far its satellite is from the node.
struct SlotNow {
  double node_rad, argument_rad;
};

SlotNow slot_at(const SlotOrbits& orbits, const Slot& slot, const time::GpsTime& gps) {
  const double t_s = time::to_seconds(gps - orbits.epoch);
  const double turned_rad = (orbits.node_rate_rad_per_s - nav::wgs84::omega_e_rad_per_s) * t_s;
  return {std::remainder((slot.node_deg - orbits.greenwich_deg) * units::kDeg + turned_rad, kFullTurn_rad),
          std::remainder(slot.argument_deg * units::kDeg + orbits.argument_rate_rad_per_s * t_s, kFullTurn_rad)};
}

void draw_clock_and_harmonics(Drawn& drawn, KeplerianEphemeris& e) {
  e.af0_s = drawn.within(3e-4);
  e.af1_s_per_s = drawn.within(5e-12);
  e.first_delay_s = drawn.within(10e-9);
  const double second_s = drawn.within(10e-9);
  if (e.message != KeplerianMessage::Lnav) e.second_delay_s = second_s;
  e.cuc_rad = drawn.within(3e-6);
  e.cus_rad = drawn.within(1e-5);
  e.crc_m = drawn.within(300.0);
  e.crs_m = drawn.within(100.0);
  e.cic_rad = drawn.within(2e-7);
  e.cis_rad = drawn.within(2e-7);
  e.i_dot_rad_per_s = drawn.within(3e-10);
}

/// Places of the messages of a system: what of them a reader of the file or the stream asks for.
void set_message(KeplerianEphemeris& e, const time::GpsTime& start) {
  const GnssSystem system = e.satellite.system;
  const time::Nanoseconds period = message_period(system);
  e.toe = e.toc = e.transmitted = reference_time_at(system, start);
  e.accuracy_m = 2.0;
  e.issue = e.issue_of_clock = 1;
  switch (system) {
    case GnssSystem::Galileo:
      e.message = KeplerianMessage::Inav;
      e.accuracy_m = 3.12;
      break;
    case GnssSystem::BeiDou:
      e.message = is_beidou_geostationary(e.satellite) ? KeplerianMessage::D2 : KeplerianMessage::D1;
      break;
    default:
      e.message = KeplerianMessage::Lnav;
      e.transmitted = e.toe + -period;
  }
}

KeplerianEphemeris keplerian(std::uint64_t seed, const SlotOrbits& orbits, const Slot& slot,
                             const time::GpsTime& start) {
  KeplerianEphemeris e;
  e.satellite = slot.satellite;
  set_message(e, start);
  const OrbitConstants earth = orbit_constants(e.satellite.system);
  const SlotNow now = slot_at(orbits, slot, e.toe);
  const double toes_rad =
      earth.omega_e_rad_per_s * time::to_seconds(broadcast::time_of_week_ns(e.satellite.system, e.toe));

  Drawn drawn(seed, e.satellite);
  draw_clock_and_harmonics(drawn, e);
  e.eccentricity = orbits.is_eccentricity_drawn ? drawn.between(0.2, 1.0) * orbits.eccentricity : orbits.eccentricity;
  e.argument_of_perigee_rad =
      orbits.is_eccentricity_drawn ? drawn.within(units::kPi) : orbits.perigee_deg * units::kDeg;
  e.m0_rad = std::remainder(now.argument_rad - e.argument_of_perigee_rad, kFullTurn_rad);
  e.delta_n_rad_per_s = drawn.between(2e-9, 6e-9);
  const double kepler = orbits.argument_rate_rad_per_s - e.delta_n_rad_per_s;
  e.sqrt_a_sqrt_m = std::sqrt(std::cbrt(earth.mu_m3_per_s2 / (kepler * kepler)));
  OrbitPlane plane{now.node_rad, orbits.inclination_deg * units::kDeg, e.argument_of_perigee_rad};
  e.omega_dot_rad_per_s = orbits.node_rate_rad_per_s;
  if (is_beidou_geostationary(e.satellite)) {
    e = held_for_run(e);
    plane = OrbitPlane::of(rotation_x(geostationary_tilt_rad()) * plane.rotation());
  }
  e.i0_rad = plane.inclination_rad;
  e.argument_of_perigee_rad = plane.perigee_rad;
  e.omega0_rad = std::remainder(plane.node_rad + toes_rad, kFullTurn_rad);
  return e;
}

GlonassEphemeris glonass(std::uint64_t seed, const SlotOrbits& orbits, const Slot& slot, const time::GpsTime& start) {
  GlonassEphemeris e;
  e.satellite = slot.satellite;
  e.channel = kGlonassChannels[slot.satellite.number - 1U];
  e.tb = reference_time_at(GnssSystem::Glonass, start);
  e.transmitted = e.tb + -message_period(GnssSystem::Glonass) / 2;
  const SlotNow now = slot_at(orbits, slot, e.tb);
  const OrbitPlane plane{now.node_rad, orbits.inclination_deg * units::kDeg, now.argument_rad};
  const Matrix3 C_eo = plane.rotation();
  const double rate = orbits.argument_rate_rad_per_s;
  const OrbitConstants earth = orbit_constants(GnssSystem::Glonass);
  const double radius_m = std::cbrt(earth.mu_m3_per_s2 / (rate * rate));
  e.r_e_m = radius_m * C_eo.col(0);
  e.v_e_m_per_s = radius_m * rate * C_eo.col(1) - earth.omega_e_rad_per_s * Vector3::UnitZ().cross(e.r_e_m);
  Drawn drawn(seed, e.satellite);
  e.tau_s = drawn.within(3e-4);
  e.gamma = drawn.within(5e-12);
  e.delta_tau_s = drawn.within(10e-9);
  return e;
}

}  // namespace

BroadcastEphemerides nominal_constellation(std::uint64_t seed, const time::GpsTime& start) {
  BroadcastEphemerides all;
  for (const SlotFamily& family : nominal_slots()) {
    for (const Slot& slot : family.slots) {
      if (slot.satellite.system == GnssSystem::Glonass) {
        all.glonass.push_back(glonass(seed, family.orbits, slot, start));
      } else {
        all.keplerian.push_back(keplerian(seed, family.orbits, slot, start));
      }
    }
  }
  return all;
}

}  // namespace inslab::satellites
