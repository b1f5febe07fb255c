#pragma once

#include <array>
#include <cstdint>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/nav/position_spline.hpp"

namespace inslab::scenario {

/// A curve's parameter over time, s: powers ascending.
struct TimeLaw {
  std::array<double, 7> c{};

  double value(double t_s) const {
    return c[0] + t_s * (c[1] + t_s * (c[2] + t_s * (c[3] + t_s * (c[4] + t_s * (c[5] + t_s * c[6])))));
  }
  double first(double t_s) const {
    return c[1] +
           t_s * (2.0 * c[2] + t_s * (3.0 * c[3] + t_s * (4.0 * c[4] + t_s * (5.0 * c[5] + t_s * (6.0 * c[6])))));
  }
  double second(double t_s) const {
    return 2.0 * c[2] + t_s * (6.0 * c[3] + t_s * (12.0 * c[4] + t_s * (20.0 * c[5] + t_s * (30.0 * c[6]))));
  }
};

/// A stretch of time over which the position is one smooth function.
struct PathPiece {
  time::Nanoseconds start{0};
  time::Nanoseconds end{0};
  nav::PositionPiece curve;
  TimeLaw law;              ///< over the time since `start`
  std::uint32_t index = 0;  ///< of the row or the waypoint that it leads away from

  /// Relative to the Earth, in the curve's frame k, m/s and m/s^2.
  nav::Vector3 velocity_k(double t_s) const { return law.first(t_s) * curve.first_k(law.value(t_s)); }
  nav::Vector3 acceleration_k(double t_s) const {
    const double u = law.value(t_s), rate = law.first(t_s);
    return rate * rate * curve.second_k(u) + law.second(t_s) * curve.first_k(u);
  }
};

}  // namespace inslab::scenario
