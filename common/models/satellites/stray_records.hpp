#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/glonass_ephemeris.hpp"
#include "inslab/data/samples/keplerian_ephemeris.hpp"

namespace inslab::satellites {

/// A record that puts its satellite elsewhere than its neighbours do.
struct StrayRecord {
  std::size_t index = 0;  ///< among the records given
  double off_m = 0.0;     ///< from the nearest neighbour
};

/// Neighbours agree to this; what maneuvers and hours of extrapolation do is below it.
inline constexpr double kMostApart_m = 1000.0;

/// The records, of any satellites and in any order, that agree with none of their neighbours: two records of the same
/// satellite and message before and two after, of Keplerian ephemerides within 4 h, of GLONASS within 1 h. Compared are
/// the positions half-way between two times of reference. A record without neighbours is none; of two alone that do not
/// agree nobody knows which is right, and both are found.
std::vector<StrayRecord> stray_records(const std::vector<KeplerianEphemeris>& records);
std::vector<StrayRecord> stray_records(const std::vector<GlonassEphemeris>& records);

}  // namespace inslab::satellites
