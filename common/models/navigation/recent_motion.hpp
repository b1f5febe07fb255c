#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/vectors.hpp"

namespace inslab::navigation {

/// How the IMU moved in the last second, from the mechanization alone: what measurements corrected meanwhile, the
/// velocity says that is asked for in the end. With v_b(t) the IMU's velocity in its own axes, the mean over an
/// interval that ends now is v_b(now) and
///
///   (1/dt) integral of (v_b(t) - v_b(now)) dt,
///
/// to which the changes that the forces and turns of the interval made are enough.
class RecentMotion {
 public:
  static constexpr double kKept_s = 1.0;

  struct Means {
    nav::Vector3 v_b_less_now = nav::Vector3::Zero();  ///< m/s
    nav::Vector3 omega_eb_b = nav::Vector3::Zero();    ///< rad/s
    nav::Vector3 v_b_rate = nav::Vector3::Zero();  ///< at which the velocity changes along the IMU's own axes, m/s^2
  };

  explicit RecentMotion(std::int64_t begin_ns)
      : steps_{{begin_ns, nav::Vector3::Zero(), nav::Vector3::Zero(), nav::Vector3::Zero()}} {}

  /// Takes the next interval: what the velocity in the IMU's own axes was at both of its ends, and the turn.
  void add(std::int64_t end_ns, const nav::Vector3& v_b_begin, const nav::Vector3& v_b_end,
           const nav::Vector3& turn_eb_b) {
    const Step& last = steps_.back();
    const double dt_s = time::to_seconds(end_ns - last.time_ns);
    const nav::Vector3 change_b = v_b_end - v_b_begin;
    steps_.push_back(
        {end_ns, last.way_b + dt_s * (gained_b_ + 0.5 * change_b), last.turn_b + turn_eb_b, gained_b_ + change_b});
    gained_b_ += change_b;
    const auto old = [&](const Step& step) { return time::to_seconds(end_ns - step.time_ns) > kKept_s; };
    // Half of the list at a time, or each step would move all others.
    if (old(steps_[steps_.size() / 2])) {
      steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(steps_.size() / 2));
    }
  }

  /// Over the interval of that length that ends now; nothing when it is longer than what is kept.
  std::optional<Means> over(std::int64_t interval_ns) const {
    const std::int64_t begin_ns = steps_.back().time_ns - interval_ns;
    if (interval_ns <= 0 || begin_ns < steps_.front().time_ns) return std::nullopt;
    const auto after = std::upper_bound(steps_.begin(), steps_.end(), begin_ns,
                                        [](std::int64_t time_ns, const Step& step) { return time_ns < step.time_ns; });
    const Step& before = *std::prev(after);
    const double part = time::to_seconds(begin_ns - before.time_ns) / time::to_seconds(after->time_ns - before.time_ns);
    const double dt_s = time::to_seconds(interval_ns);
    const nav::Vector3 way_b = steps_.back().way_b - (before.way_b + part * (after->way_b - before.way_b));
    const nav::Vector3 turn_b = steps_.back().turn_b - (before.turn_b + part * (after->turn_b - before.turn_b));
    const nav::Vector3 gain_b = gained_b_ - (before.gained_b + part * (after->gained_b - before.gained_b));
    return Means{way_b / dt_s - gained_b_, turn_b / dt_s, gain_b / dt_s};
  }

 private:
  struct Step {
    std::int64_t time_ns;
    nav::Vector3 way_b;   ///< m, integral of gained_b_
    nav::Vector3 turn_b;  ///< rad
    nav::Vector3 gained_b;
  };
  std::vector<Step> steps_;
  nav::Vector3 gained_b_ = nav::Vector3::Zero();  ///< m/s, of all changes so far
};

}  // namespace inslab::navigation
