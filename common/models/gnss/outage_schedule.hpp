#pragma once

#include <vector>

#include "inslab/data/samples/outage.hpp"
#include "inslab/nav/geodesy.hpp"

namespace inslab::gnss {

/// When and where a receiver has no signals. Depends on time and place alone, not on what came before.
class OutageSchedule {
 public:
  /// Throws std::invalid_argument when a time is negative or not finite, when a period is not above its outage's
  /// length, or when an area has no points.
  OutageSchedule(const std::vector<Outage>& outages, const std::vector<OutageArea>& areas);

  /// Whether there is no signal at sim time `time_ns` for an antenna at `antenna`. The distance from an area's path is
  /// that of the points of the ellipsoid, straight through it: a leg of 10 km runs 2 m deep in its middle.
  bool covers(std::int64_t time_ns, const nav::Geodetic& antenna) const;

 private:
  struct Span {
    std::int64_t start_ns;
    std::int64_t duration_ns;
    std::int64_t period_ns;  ///< 0: once
  };
  struct Area {
    double radius_m;
    std::vector<Vector3> path_e_m;
    Vector3 centre_e_m;  ///< all of the area lies within reach_m of it
    double reach_m;
  };

  std::vector<Span> spans_;
  std::vector<Area> areas_;
};

}  // namespace inslab::gnss
