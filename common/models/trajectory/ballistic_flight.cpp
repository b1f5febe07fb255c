#include "inslab/models/trajectory/ballistic_flight.hpp"

#include <algorithm>

namespace inslab::trajectory {

namespace {

VehicleMotion carried(VehicleMotion vehicle, time::Nanoseconds from, time::Nanoseconds step) {
  vehicle.step(time::to_seconds(from), time::to_seconds(from + step), time::to_seconds(step));
  return vehicle;
}

}  // namespace

time::Nanoseconds time_back_at_start_height(VehicleMotion vehicle, time::Nanoseconds at_most) {
  const double start_m = vehicle.position().height_m;
  if (vehicle.v_n().z() >= 0.0) return at_most;
  time::Nanoseconds now{0};
  while (now < at_most && nav::in_domain(vehicle.position())) {
    const time::Nanoseconds longest = time::from_seconds(vehicle.longest_step_s());
    const time::Nanoseconds step = std::min(std::max(longest, time::Nanoseconds(1)), at_most - now);
    VehicleMotion next = carried(vehicle, now, step);
    if (next.position().height_m < start_m) {
      time::Nanoseconds above{0}, below = step;
      while (below - above > time::Nanoseconds(1)) {
        const time::Nanoseconds middle = above + (below - above) / 2;
        (carried(vehicle, now, middle).position().height_m < start_m ? below : above) = middle;
      }
      return now + above;
    }
    vehicle = std::move(next);
    now += step;
  }
  return at_most;
}

}  // namespace inslab::trajectory
