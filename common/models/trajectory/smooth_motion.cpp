#include "inslab/models/trajectory/smooth_motion.hpp"

#include <utility>

namespace inslab::trajectory {

namespace {

std::vector<double> intervals_s(const std::vector<time::Nanoseconds>& times) {
  std::vector<double> intervals;
  intervals.reserve(times.size());
  for (std::size_t k = 1; k < times.size(); ++k) intervals.push_back(time::to_seconds(times[k] - times[k - 1]));
  return intervals;
}

}  // namespace

AttitudeCurve::AttitudeCurve(std::vector<time::Nanoseconds> times, std::vector<nav::Quaternion> q_ev)
    : times_(std::move(times)), spline_(std::move(q_ev), intervals_s(times_)) {}

}  // namespace inslab::trajectory
