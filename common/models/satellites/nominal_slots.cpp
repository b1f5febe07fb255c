#include "inslab/models/satellites/nominal_slots.hpp"

#include <cmath>

#include "inslab/foundation/units/units.hpp"
#include "inslab/models/satellites/orbit_constants.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::satellites {

namespace {

constexpr double kEarth_rad_per_s = nav::wgs84::omega_e_rad_per_s;

struct GpsPlane {
  double node_deg;
  std::array<double, 4> arguments_deg;
};

constexpr std::array<GpsPlane, 6> kGpsPlanes{{{272.847, {268.126, 161.786, 11.676, 41.806}},
                                              {332.847, {80.956, 173.336, 309.976, 204.376}},
                                              {32.847, {111.876, 11.796, 339.666, 241.556}},
                                              {92.847, {135.226, 265.446, 35.156, 167.356}},
                                              {152.847, {197.046, 302.596, 66.066, 333.686}},
                                              {212.847, {238.886, 345.226, 105.206, 135.346}}}};
// 18 h 36 min 14.4 s, as the table gives it; 9 leap seconds since 1980.
constexpr SlotOrbits kGps{
    {703, (4 * 86400 + 9) * 1'000'000'000LL}, 279.06, 26559.7e3, 55.0, 0.0, 2.0 * kEarth_rad_per_s, 0.01};

// 2016-11-21 00:00 UTC: 17 leap seconds, Greenwich mean sidereal time (IAU 1982).
constexpr time::GpsTime kEpoch{1924, (86400 + 17) * 1'000'000'000LL};
constexpr double kGreenwich_deg = 60.4264;
constexpr SlotOrbits kGalileo{
    kEpoch, kGreenwich_deg, 29599.8e3, 56.0, -0.02764398 * units::kDeg / 86400.0, 613.72253566 * units::kDeg / 86400.0,
    3e-4};

/// How fast the node of a circular orbit goes back, by the flattening of the Earth: -3/2 J2 n (a_e / a)^2 cos i (Kaula,
/// Theory of Satellite Geodesy, equation 3.74).
double node_rate_rad_per_s(double radius_m, double rate_rad_per_s, double inclination_deg) {
  const double ratio = kPz90Radius_m / radius_m;
  return -1.5 * kPz90J2 * rate_rad_per_s * ratio * ratio * std::cos(inclination_deg * units::kDeg);
}

SlotOrbits circular(GnssSystem system, double radius_m, double inclination_deg) {
  const double mu = orbit_constants(system).mu_m3_per_s2;
  const double rate = std::sqrt(mu / (radius_m * radius_m * radius_m));
  return {kEpoch, kGreenwich_deg, radius_m, inclination_deg, node_rate_rad_per_s(radius_m, rate, inclination_deg), rate,
          3e-4};
}

/// A satellite that stays over its longitude, or draws its figure about it: node and argument go round together.
SlotOrbits synchronous(double inclination_deg, double eccentricity, double perigee_deg) {
  constexpr double kRadius_m = 42164.2e3;
  const double node_rate = node_rate_rad_per_s(kRadius_m, kEarth_rad_per_s, inclination_deg);
  return {kEpoch,       0.0,   kRadius_m,  inclination_deg, node_rate, kEarth_rad_per_s - node_rate,
          eccentricity, false, perigee_deg};
}

/// At the epoch `argument_deg` from its node, and on the mean over `longitude_deg`; the epoch's Greenwich is at 0.
Slot over(SatelliteId satellite, double longitude_deg, double argument_deg) {
  return {satellite, longitude_deg - argument_deg, argument_deg};
}

SlotFamily gps() {
  SlotFamily family{kGps, {}};
  std::uint8_t number = 0;
  for (const GpsPlane& plane : kGpsPlanes) {
    for (const double argument_deg : plane.arguments_deg) {
      family.slots.push_back({{GnssSystem::Gps, ++number}, plane.node_deg, argument_deg});
    }
  }
  return family;
}

/// The double nearest to the decimal number, as a table that is written out has it.
double thousandths(double angle_deg) { return std::round(1000.0 * angle_deg) / 1000.0; }

/// Walker 24/3/1: planes 120 deg apart, slots 45 deg apart, 15 deg more of argument from plane to plane.
SlotFamily walker(const SlotOrbits& orbits, GnssSystem system, const std::array<std::uint8_t, 24>& numbers,
                  double node_deg, double argument_deg) {
  SlotFamily family{orbits, {}};
  for (int i = 0; i < 24; ++i) {
    const int plane = i / 8;
    family.slots.push_back({{system, numbers[static_cast<std::size_t>(i)]},
                            thousandths(std::fmod(node_deg + 120.0 * plane, 360.0)),
                            thousandths(argument_deg + 15.0 * plane + 45.0 * (i % 8))});
  }
  return family;
}

constexpr std::array<std::uint8_t, 24> kInOrder{1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12,
                                                13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24};
// The numbers that BeiDou-3 flies its medium orbits with.
constexpr std::array<std::uint8_t, 24> kBeiDouNumbers{19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30,
                                                      32, 33, 34, 35, 36, 37, 41, 42, 43, 44, 45, 46};

SlotOrbits glonass_orbits() {
  constexpr double kPeriod_s = 11 * 3600 + 15 * 60 + 44;
  const double rate = 2.0 * units::kPi / kPeriod_s;
  const double mu = orbit_constants(GnssSystem::Glonass).mu_m3_per_s2;
  return circular(GnssSystem::Glonass, std::cbrt(mu / (rate * rate)), 64.8);
}

std::vector<SlotFamily> make_slots() {
  constexpr auto kBeiDou = GnssSystem::BeiDou;
  constexpr auto kQzss = GnssSystem::Qzss;
  return {
      gps(),
      walker(kGalileo, GnssSystem::Galileo, kInOrder, 317.632, 0.153),
      walker(circular(kBeiDou, 27906e3, 55.0), kBeiDou, kBeiDouNumbers, 10.0, 20.0),
      {synchronous(55.0, 2e-3, 190.0),
       {over({kBeiDou, 38}, 118.0, 0.0), over({kBeiDou, 39}, 118.0, 120.0), over({kBeiDou, 40}, 118.0, 240.0)}},
      {synchronous(0.5, 3e-4, 40.0),
       {over({kBeiDou, 59}, 140.0, 60.0), over({kBeiDou, 60}, 80.0, 60.0), over({kBeiDou, 61}, 110.5, 60.0)}},
      walker(glonass_orbits(), GnssSystem::Glonass, kInOrder, 50.0, 0.0),
      {synchronous(41.0, 0.075, 270.0),
       {over({kQzss, 2}, 135.0, 30.0), over({kQzss, 3}, 135.0, 150.0), over({kQzss, 4}, 135.0, 270.0)}},
      {synchronous(0.05, 2e-4, 75.0), {over({kQzss, 7}, 127.0, 20.0)}},
  };
}

}  // namespace

const std::vector<SlotFamily>& nominal_slots() {
  static const std::vector<SlotFamily> kSlots = make_slots();
  return kSlots;
}

}  // namespace inslab::satellites
