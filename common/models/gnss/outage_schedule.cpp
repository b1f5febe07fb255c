#include "inslab/models/gnss/outage_schedule.hpp"

#include <algorithm>
#include <stdexcept>

#include "inslab/foundation/time/gps_time.hpp"

namespace inslab::gnss {

namespace {

double distance_from_leg(const Vector3& point, const Vector3& from, const Vector3& to) {
  const Vector3 leg = to - from;
  const double square = leg.squaredNorm();
  const double along = square > 0.0 ? std::clamp((point - from).dot(leg) / square, 0.0, 1.0) : 0.0;
  return (point - from - along * leg).norm();
}

double distance_from_path(const Vector3& point, const std::vector<Vector3>& path) {
  double distance = (point - path.front()).norm();
  for (std::size_t i = 1; i < path.size(); ++i) {
    distance = std::min(distance, distance_from_leg(point, path[i - 1], path[i]));
  }
  return distance;
}

}  // namespace

OutageSchedule::OutageSchedule(const std::vector<Outage>& outages, const std::vector<OutageArea>& areas) {
  for (const Outage& outage : outages) {
    const bool fits = outage.start_s >= 0.0 && outage.duration_s >= 0.0 &&
                      (outage.period_s == 0.0 || outage.period_s > outage.duration_s);
    if (!fits) {
      throw std::invalid_argument("an outage of " + std::to_string(outage.duration_s) + " s from " +
                                  std::to_string(outage.start_s) + " s every " + std::to_string(outage.period_s) +
                                  " s; expected 0 or more, and a period above the length");
    }
    spans_.push_back({time::from_seconds(outage.start_s).count(), time::from_seconds(outage.duration_s).count(),
                      time::from_seconds(outage.period_s).count()});
  }
  for (const OutageArea& area : areas) {
    if (area.path.empty()) throw std::invalid_argument("an outage area without points");
    Area known{area.radius_m, {}, Vector3::Zero(), 0.0};
    for (const GroundPoint& point : area.path) known.path_e_m.push_back(ground_point_e(point));
    for (const Vector3& point : known.path_e_m) {
      known.centre_e_m += point / static_cast<double>(known.path_e_m.size());
    }
    for (const Vector3& point : known.path_e_m) {
      known.reach_m = std::max(known.reach_m, (point - known.centre_e_m).norm() + area.radius_m);
    }
    areas_.push_back(known);
  }
}

bool OutageSchedule::covers(std::int64_t time_ns, const nav::Geodetic& antenna) const {
  const auto holds_time = [time_ns](const Span& span) {
    const std::int64_t since_ns = time_ns - span.start_ns;
    if (since_ns < 0) return false;
    return (span.period_ns == 0 ? since_ns : since_ns % span.period_ns) < span.duration_ns;
  };
  if (std::any_of(spans_.begin(), spans_.end(), holds_time)) return true;
  if (areas_.empty()) return false;
  const Vector3 below_e_m = nav::ecef_from_geodetic({antenna.latitude_rad, antenna.longitude_rad, 0.0});
  return std::any_of(areas_.begin(), areas_.end(), [&below_e_m](const Area& area) {
    return (below_e_m - area.centre_e_m).norm() <= area.reach_m &&
           distance_from_path(below_e_m, area.path_e_m) <= area.radius_m;
  });
}

}  // namespace inslab::gnss
