#include "inslab/models/satellites/frozen_sky.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "inslab/data/broadcast/message_field.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/models/satellites/reference_time.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::satellites {

namespace {

constexpr time::Nanoseconds kWeek = std::chrono::hours(7 * 24);

const time::GpsTime& reference(const KeplerianEphemeris& e) { return e.toe; }
const time::GpsTime& reference(const GlonassEphemeris& e) { return e.tb; }
bool is_taken(const KeplerianEphemeris& e) { return e.health == 0 && e.message != KeplerianMessage::Fnav; }
bool is_taken(const GlonassEphemeris& e) { return e.health == 0; }

/// One record a satellite; of two as near the earlier, whatever their order.
template <class Ephemeris>
std::map<SatelliteId, Ephemeris> nearest_to(const time::GpsTime& start, const std::vector<Ephemeris>& records) {
  const auto distance = [&](const Ephemeris& e) { return std::chrono::abs(reference(e) - start); };
  std::map<SatelliteId, Ephemeris> chosen;
  for (const Ephemeris& e : records) {
    if (!is_taken(e)) continue;
    const auto [at, is_new] = chosen.emplace(e.satellite, e);
    const bool is_nearer = distance(e) < distance(at->second);
    const bool is_earlier = distance(e) == distance(at->second) && (reference(e) - reference(at->second)).count() < 0;
    if (!is_new && (is_nearer || is_earlier)) at->second = e;
  }
  return chosen;
}

KeplerianEphemeris from_start_on(const KeplerianEphemeris& record, const time::GpsTime& start) {
  const KeplerianEphemeris held = held_for_run(record);
  if (std::chrono::abs(held.toe - start) <= kWeek) return held;
  KeplerianEphemeris moved = re_referenced(held, reference_time_at(held.satellite.system, start));
  moved.af0_s = held.af0_s;
  moved.af1_s_per_s = held.af1_s_per_s;
  return moved;
}

/// Whole half hours from the first record's time to the start; all satellites move by the same, so the constellation
/// keeps its shape.
time::Nanoseconds shift_to(const time::GpsTime& start, const time::GpsTime& tb) {
  const time::Nanoseconds away = start - tb;
  if (std::chrono::abs(away) <= kWeek) return time::Nanoseconds(0);
  constexpr time::Nanoseconds kHalfHour = std::chrono::minutes(30);
  return away / kHalfHour * kHalfHour;
}

template <class Ephemeris>
Ephemeris rounded(const Ephemeris& ephemeris) {
  try {
    return broadcast::as_broadcast(ephemeris);
  } catch (const std::range_error& error) {
    throw std::range_error(name_of(ephemeris.satellite) + ": " + error.what());
  }
}

}  // namespace

FrozenSky::FrozenSky(const BroadcastEphemerides& records, const time::GpsTime& start) {
  for (const auto& [satellite, record] : nearest_to(start, records.keplerian)) {
    keplerian_.push_back(from_start_on(record, start));
  }
  const auto chosen = nearest_to(start, records.glonass);
  for (const auto& [satellite, record] : chosen) {
    GlonassEphemeris e = held_for_run(record);
    e.tb = e.tb + shift_to(start, chosen.begin()->second.tb);
    glonass_.emplace_back(e);
  }
}

std::vector<SkySight> FrozenSky::seen_from(const AntennaState& antenna, double least_elevation_rad) {
  const nav::Geodetic place = nav::geodetic_from_ecef(antenna.r_e_m);
  const Matrix3 C_en = nav::C_en(place.latitude_rad, place.longitude_rad);
  std::vector<SkySight> seen;
  const auto look = [&](const SatelliteId& satellite, std::int32_t channel, double radius_m, auto state_at) {
    const time::Nanoseconds before = usual_light_time(radius_m);
    const Sight found = sight({state_at(antenna.gps + -before), before}, antenna);
    const AzimuthElevation direction = direction_of(found.line_e, C_en);
    if (direction.elevation_rad >= least_elevation_rad) seen.push_back({satellite, channel, found, direction});
  };
  for (const KeplerianEphemeris& e : keplerian_) {
    look(e.satellite, 0, e.sqrt_a_sqrt_m * e.sqrt_a_sqrt_m, [&](const time::GpsTime& t) { return kepler_state(e, t); });
  }
  for (GlonassOrbit& orbit : glonass_) {
    const GlonassEphemeris& e = orbit.ephemeris();
    look(e.satellite, e.channel, e.r_e_m.norm(), [&](const time::GpsTime& t) { return orbit.at(t); });
  }
  std::sort(seen.begin(), seen.end(), [](const SkySight& a, const SkySight& b) { return a.satellite < b.satellite; });
  return seen;
}

BroadcastEphemerides FrozenSky::messages_at(const time::GpsTime& gps) {
  BroadcastEphemerides messages;
  for (const KeplerianEphemeris& e : keplerian_) {
    messages.keplerian.push_back(rounded(re_referenced(e, reference_time_at(e.satellite.system, gps))));
  }
  for (GlonassOrbit& orbit : glonass_) {
    messages.glonass.push_back(rounded(re_referenced(orbit, reference_time_at(GnssSystem::Glonass, gps))));
  }
  return messages;
}

}  // namespace inslab::satellites
