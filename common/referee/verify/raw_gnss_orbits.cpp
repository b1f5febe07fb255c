#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "inslab/data/broadcast/gnss_signal.hpp"
#include "inslab/formats/rinex/precise_orbits.hpp"
#include "inslab/foundation/files/file_error.hpp"
#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"
#include "inslab/referee/verify/raw_gnss_block.hpp"
#include "inslab/sim/navigation_files.hpp"

namespace inslab::verify {

namespace {

constexpr double kLight_m_per_s = broadcast::kSpeedOfLight_m_per_s;

/// A kind of orbit that is judged by itself.
enum class OrbitKind { Gps, Glonass, Galileo, BeiDouMedium, BeiDouInclined, BeiDouGeostationary, Qzss };

OrbitKind kind_of(const SatelliteId& satellite, double radius_m) {
  constexpr double kBetween_m = 35e6;
  switch (satellite.system) {
    case GnssSystem::Gps:
      return OrbitKind::Gps;
    case GnssSystem::Glonass:
      return OrbitKind::Glonass;
    case GnssSystem::Galileo:
      return OrbitKind::Galileo;
    case GnssSystem::Qzss:
      return OrbitKind::Qzss;
    case GnssSystem::BeiDou:
      break;
  }
  if (is_beidou_geostationary(satellite)) return OrbitKind::BeiDouGeostationary;
  return radius_m < kBetween_m ? OrbitKind::BeiDouMedium : OrbitKind::BeiDouInclined;
}

/// A broadcast position and clock beside the precise ones.
struct Compared {
  SatelliteId satellite;
  time::GpsTime gps;
  double apart_m = 0.0;
  std::optional<double> clock_m;  ///< broadcast minus precise, without relativity
};

/// The record whose reference is nearest, at most `most` away; none of an unhealthy satellite.
template <class Ephemeris, class ReferenceOf>
const Ephemeris* nearest(const std::vector<Ephemeris>& records, const SatelliteId& satellite, const time::GpsTime& gps,
                         time::Nanoseconds most, ReferenceOf reference_of) {
  const Ephemeris* found = nullptr;
  time::Nanoseconds best = most + time::Nanoseconds(1);
  for (const Ephemeris& e : records) {
    const time::Nanoseconds away = std::chrono::abs(gps - reference_of(e));
    if (e.satellite != satellite || e.health != 0 || away >= best) continue;
    found = &e;
    best = away;
  }
  return found;
}

/// The state by the nearest record: of Keplerian ones within `most`, of GLONASS within 15 minutes.
std::optional<satellites::SatelliteState> broadcast_state(const sim::NavigationFiles& files,
                                                          const SatelliteId& satellite, const time::GpsTime& gps,
                                                          time::Nanoseconds most, const RawGnssSubjects& subjects) {
  if (satellite.system == GnssSystem::Glonass) {
    const auto* e =
        nearest(files.glonass, satellite, gps, std::chrono::minutes(15), [](const auto& r) { return r.tb; });
    return e == nullptr ? std::nullopt : std::optional(satellites::GlonassOrbit(*e).at(gps));
  }
  const auto* e = nearest(files.keplerian, satellite, gps, most, [](const auto& r) { return r.toe; });
  return e == nullptr ? std::nullopt : std::optional(subjects.state(*e, gps));
}

/// Of a clock that has it: -2 r.v / c^2. Precise clocks have none, those of GLONASS hold it in their messages.
double relativity_s(const SatelliteId& satellite, const satellites::SatelliteState& state) {
  if (satellite.system == GnssSystem::Glonass) return 0.0;
  return -2.0 * state.r_e_m.dot(state.v_e_m_per_s) / (kLight_m_per_s * kLight_m_per_s);
}

std::map<OrbitKind, std::vector<Compared>> compare(const sim::NavigationFiles& files,
                                                   const std::vector<rinex::PreciseEpoch>& epochs,
                                                   time::Nanoseconds most, const RawGnssSubjects& subjects) {
  std::map<OrbitKind, std::vector<Compared>> compared;
  for (const rinex::PreciseEpoch& epoch : epochs) {
    for (const rinex::PreciseState& precise : epoch.states) {
      if (!precise.r_e_m) continue;
      const auto state = broadcast_state(files, precise.satellite, epoch.gps, most, subjects);
      if (!state) continue;
      Compared one{precise.satellite, epoch.gps, (state->r_e_m - *precise.r_e_m).norm(), {}};
      if (precise.clock_s) {
        one.clock_m = kLight_m_per_s * (state->clock_s - relativity_s(precise.satellite, *state) - *precise.clock_s);
      }
      compared[kind_of(precise.satellite, precise.r_e_m->norm())].push_back(one);
    }
  }
  return compared;
}

/// The value that a part of them does not exceed.
double quantile(std::vector<double> values, double part) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

std::vector<double> distances_m(const std::vector<Compared>& compared) {
  std::vector<double> all;
  for (const Compared& one : compared) all.push_back(one.apart_m);
  return all;
}

/// RMS of the clocks once the mean of each group is taken off: of an epoch (the time of the precise clocks is their
/// own), or of a satellite (whose delays are in both).
template <class GroupOf>
double clock_rms_m(const std::vector<Compared>& compared, GroupOf group_of) {
  using Group = decltype(group_of(compared.front()));
  std::map<Group, std::pair<double, int>> sums;
  for (const Compared& one : compared) {
    if (!one.clock_m) continue;
    auto& [sum, count] = sums[group_of(one)];
    sum += *one.clock_m;
    ++count;
  }
  double squares = 0.0;
  int count = 0;
  for (const Compared& one : compared) {
    if (!one.clock_m) continue;
    const auto& [sum, in_group] = sums[group_of(one)];
    const double off = *one.clock_m - sum / in_group;
    squares += off * off;
    ++count;
  }
  return std::sqrt(squares / count);
}

std::string with_limit(double found, double limit) { return fmt::format("{:.2f} ({:.2f})", found, limit); }

struct KindLimits {
  OrbitKind kind;
  const char* name;
  double median_m, clock_m;
};

// What a prototype found on the same data, and a fifth more.
constexpr std::array<KindLimits, 7> kLimits{
    {{OrbitKind::Gps, "GPS", 1.52 * 1.2, 0.17 * 1.2},
     {OrbitKind::Glonass, "GLONASS", 2.63 * 1.2, 0.17 * 1.2},
     {OrbitKind::Galileo, "Galileo", 0.89 * 1.2, 0.17 * 1.2},
     {OrbitKind::BeiDouMedium, "BeiDou, medium", 1.25 * 1.2, 0.17 * 1.2},
     {OrbitKind::BeiDouInclined, "BeiDou, inclined", 1.71 * 1.2, 0.17 * 1.2},
     {OrbitKind::BeiDouGeostationary, "BeiDou, geostationary", 9.4 * 1.2, 0.17 * 1.2},
     {OrbitKind::Qzss, "QZSS", 2.33 * 1.2, 0.17 * 1.2}}};

void add_2010(const std::string& folder, const RawGnssSubjects& subjects, Table& table) {
  const sim::NavigationFiles files = sim::load_navigation_files({folder + "/brdc1820.10n"});
  const auto compared =
      compare(files, rinex::read_precise_orbits(folder + "/igs15904.sp3"), std::chrono::hours(2), subjects);
  const std::vector<Compared>& gps = compared.at(OrbitKind::Gps);
  const std::vector<double> apart_m = distances_m(gps);
  constexpr double kMedian_m = 1.8, kMost95_m = 3.6, kMost_m = 6.5, kClock_m = 1.3;
  const double median_m = quantile(apart_m, 0.5), most95_m = quantile(apart_m, 0.95), most_m = quantile(apart_m, 1.0),
               clock_m = clock_rms_m(gps, [](const Compared&one) { return one.gps.time_of_week_ns; });
  table.rows.push_back({{"GPS, 2010-07-01", std::to_string(gps.size()), with_limit(median_m, kMedian_m),
                         with_limit(most95_m, kMost95_m), with_limit(most_m, kMost_m), with_limit(clock_m, kClock_m)},
                        median_m <= kMedian_m && most95_m <= kMost95_m && most_m <= kMost_m && clock_m <= kClock_m});
  for (const std::string& refused : files.refused) table.notes.push_back("Refused: " + refused + ".");
}

void add_2023(const std::string& folder, const RawGnssSubjects& subjects, Table& table) {
  const std::string place = folder + "/simulators/BRDC_20230080000/";
  const sim::NavigationFiles files = sim::load_navigation_files({place + "BRDM00DLR_S_20230081000_01D_MN.rnx"});
  const auto compared = compare(files, rinex::read_precise_orbits(place + "GFZ0MGXRAP_20230080000_01D_05M_ORB.SP3"),
                                std::chrono::hours(1), subjects);
  for (const KindLimits& limits : kLimits) {
    const std::vector<Compared>& kind = compared.at(limits.kind);
    const std::vector<double> apart_m = distances_m(kind);
    const double median_m = quantile(apart_m, 0.5),
                 clock_m = clock_rms_m(kind, [](const Compared&one) { return one.satellite; });
    table.rows.push_back({{fmt::format("{}, 2023-01-08", limits.name), std::to_string(kind.size()),
                           with_limit(median_m, limits.median_m), fmt::format("{:.2f}", quantile(apart_m, 0.95)),
                           fmt::format("{:.2f}", quantile(apart_m, 1.0)), with_limit(clock_m, limits.clock_m)},
                          median_m <= limits.median_m && clock_m <= limits.clock_m});
  }
}

}  // namespace

RawGnssSubjects product_satellites() { return {satellites::kepler_state, satellites::sight}; }

Table raw_gnss_orbits(const std::string& folder, const RawGnssSubjects& subjects) {
  Table table;
  table.title = "Broadcast orbits and clocks against precise ones, m (limit)";
  table.columns = {"", "compared", "median", "95 %", "largest", "clock, RMS"};
  if (std::filesystem::exists(folder + "/brdc1820.10n")) {
    add_2010(folder, subjects, table);
  } else {
    table.left_out.emplace_back("orbits of 2010-07-01 (brdc1820.10n, igs15904.sp3)");
  }
  if (std::filesystem::exists(folder + "/simulators/BRDC_20230080000")) {
    add_2023(folder, subjects, table);
  } else {
    table.left_out.emplace_back("orbits of 2023-01-08 (simulators/BRDC_20230080000)");
  }
  table.judged = !table.rows.empty();
  table.notes.push_back(
      "Records within 2 h (2010), 1 h (2023), 15 min (GLONASS). Precise positions are of the centre of mass, "
      "0.7 to 2 m from the antenna that is broadcast. Clocks: 2010 less the mean of each epoch, 2023 less that of each "
      "satellite.");
  return table;
}

std::vector<Table> raw_gnss_tables(const std::string& folder) {
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw files::ReadError(folder + ": is no folder; expected the one of the reference data (docs/verification.md)");
  }
  return {raw_gnss_orbits(folder), raw_gnss_ranges(folder)};
}

}  // namespace inslab::verify
