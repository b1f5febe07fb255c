#include "inslab/models/satellites/stray_records.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "inslab/models/satellites/glonass_orbit.hpp"
#include "inslab/models/satellites/kepler_orbit.hpp"

namespace inslab::satellites {

namespace {

constexpr double kNoNeighbour = std::numeric_limits<double>::infinity();

// What the search needs of either kind of record.
const time::GpsTime& reference_of(const KeplerianEphemeris& e) { return e.toe; }
const time::GpsTime& reference_of(const GlonassEphemeris& e) { return e.tb; }
int message_of(const KeplerianEphemeris& e) { return static_cast<int>(e.message); }
int message_of(const GlonassEphemeris&) { return 0; }
Vector3 position_of(const KeplerianEphemeris& e, const time::GpsTime& gps) { return kepler_state(e, gps).r_e_m; }
Vector3 position_of(const GlonassEphemeris& e, const time::GpsTime& gps) { return GlonassOrbit(e).at(gps).r_e_m; }
time::Nanoseconds most_between(const KeplerianEphemeris&) { return std::chrono::hours(4); }
time::Nanoseconds most_between(const GlonassEphemeris&) { return std::chrono::hours(1); }

template <class Ephemeris>
bool comes_before(const Ephemeris& a, const Ephemeris& b) {
  if (a.satellite != b.satellite) return a.satellite < b.satellite;
  if (message_of(a) != message_of(b)) return message_of(a) < message_of(b);
  return (reference_of(a) - reference_of(b)).count() < 0;
}

/// How far apart two records put their satellite; infinite when they are no neighbours.
template <class Ephemeris>
double apart_m(const Ephemeris& earlier, const Ephemeris& later) {
  if (earlier.satellite != later.satellite || message_of(earlier) != message_of(later)) return kNoNeighbour;
  const time::Nanoseconds between = reference_of(later) - reference_of(earlier);
  if (between > most_between(earlier)) return kNoNeighbour;
  const time::GpsTime middle = reference_of(earlier) + between / 2;
  return (position_of(earlier, middle) - position_of(later, middle)).norm();
}

template <class Ephemeris>
std::vector<StrayRecord> stray(const std::vector<Ephemeris>& records) {
  std::vector<std::size_t> order(records.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return comes_before(records[a], records[b]); });
  std::vector<StrayRecord> found;
  // Two on either side: one beside the first or the last record may itself be the stray one.
  constexpr std::size_t kNeighbours = 2;
  for (std::size_t i = 0; i < order.size(); ++i) {
    double off_m = kNoNeighbour;
    for (std::size_t step = 1; step <= kNeighbours; ++step) {
      if (i >= step) off_m = std::min(off_m, apart_m(records[order[i - step]], records[order[i]]));
      if (i + step < order.size()) off_m = std::min(off_m, apart_m(records[order[i]], records[order[i + step]]));
    }
    if (off_m > kMostApart_m && off_m < kNoNeighbour) found.push_back({order[i], off_m});
  }
  return found;
}

}  // namespace

std::vector<StrayRecord> stray_records(const std::vector<KeplerianEphemeris>& records) { return stray(records); }
std::vector<StrayRecord> stray_records(const std::vector<GlonassEphemeris>& records) { return stray(records); }

}  // namespace inslab::satellites
