#pragma once

#include <string>
#include <vector>

#include "inslab/nav/geodesy.hpp"

namespace inslab::recordings {

/// A track for a globe (KML 2.2, OGC 07-147r2): one line at the heights of the track, one on the ground under it, the
/// two ends as points. However long the run, at most kMaxPoints points are kept, evenly spaced in their number.
///
/// KML's heights are above the geoid, the track's above the ellipsoid: they differ by the geoid's height (-107 to +86
/// m), which is why the line on the ground is there.
class KmlTrack {
 public:
  static constexpr std::size_t kMaxPoints = 20000;

  void add(const nav::Geodetic& position);
  /// Points kept.
  std::size_t size() const { return points_.size(); }
  /// Writes the file. Throws WriteError, and std::logic_error when there is no point.
  void write(const std::string& path, const std::string& name) const;

 private:
  std::vector<nav::Geodetic> points_;
  nav::Geodetic last_;
  std::uint64_t added_ = 0;
  std::uint64_t every_ = 1;
};

}  // namespace inslab::recordings
