#pragma once

#include <cmath>

#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// Stage 5a: the low-pass filter of a sensor's bandwidth, per axis, from the rate u that the sensor feels to the rate y
/// whose integral it puts out:
///
///   first order    y' = w (u - y)                                  w = 2 pi bandwidth
///   second order   y'' = w^2 (u - y) - sqrt(2) w y'                Butterworth's damping
///
/// Solved exactly for u constant over each interval, with the integral of y as output; so nothing is lost: output and
/// input increments differ by what the filter's state holds back. It starts settled on the first interval's input.
class Bandwidth {
 public:
  Bandwidth(const TriadParameters& parameters, double dt_s) : dt_s_(dt_s) { retune(parameters); }

  bool is_off() const { return is_off_; }

  /// Takes another bandwidth between two intervals; the states go on.
  void retune(const TriadParameters& parameters) {
    is_off_ = parameters.bandwidth_hz.isZero(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      // Both orders decay with s and the second turns by s dt: with Butterworth's damping w exp(+-3 pi i/4) are the
      // poles, s = w / sqrt(2).
      const double w = 2.0 * units::kPi * parameters.bandwidth_hz[axis];
      Axis& a = axes_[axis];
      a.order = w == 0.0 ? 0 : parameters.bandwidth_order == FilterOrder::First ? 1 : 2;
      a.s = a.order == 2 ? w * std::sqrt(0.5) : w;
      a.decay = std::exp(-a.s * dt_s_);
      a.missing = -std::expm1(-a.s * dt_s_);
      a.cosine = std::cos(a.s * dt_s_);
      a.sine = std::sin(a.s * dt_s_);
      if (a.order == 0) a.starts = true;
    }
  }

  /// The next interval begins settled on its own input, as after a relocation of the sensor.
  void restart() {
    for (Axis& axis : axes_) axis.starts = true;
  }

  /// The increment that comes out of the filter, rad | m/s.
  Vector3 filtered(const Vector3& increment) {
    Vector3 out;
    for (int axis = 0; axis < 3; ++axis) out[axis] = axes_[axis].filtered(increment[axis], dt_s_);
    return out;
  }

  /// What goes on from sample to sample (recovery/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    for (auto& axis : self.axes_) visit(axis.starts, axis.y, axis.slope);
  }

 private:
  struct Axis {
    int order = 0;
    double s = 0.0;  ///< 1/s
    double decay = 1.0;
    double missing = 0.0;  ///< 1 - decay
    double cosine = 1.0;
    double sine = 0.0;
    bool starts = true;
    double y = 0.0;      ///< rad/s | m/s^2
    double slope = 0.0;  ///< y', second order alone

    double filtered(double increment, double dt_s) {
      if (order == 0) return increment;
      const double u = increment / dt_s;
      if (starts) {
        y = u;
        slope = 0.0;
        starts = false;
      }
      const double z = y - u;  // z follows the filter's own equation: it decays
      if (order == 1) {
        y = u + z * decay;
        return increment + z * missing / s;
      }
      const double z_end = decay * (z * cosine + (slope / s + z) * sine);
      const double slope_end = decay * (slope * cosine - (slope + 2.0 * s * z) * sine);
      // z'' + 2 s z' + 2 s^2 z = 0, integrated.
      const double held_back = ((slope_end - slope) / s + 2.0 * (z_end - z)) / (2.0 * s);
      y = u + z_end;
      slope = slope_end;
      return increment - held_back;
    }
  };

  double dt_s_;
  std::array<Axis, 3> axes_;
  bool is_off_ = true;
};

}  // namespace inslab::imu
