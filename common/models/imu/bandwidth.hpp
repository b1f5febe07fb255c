#pragma once

#include "inslab/models/imu/low_pass.hpp"
#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// The filters of a triad as its parameters say.
inline LowPasses low_passes(const TriadParameters& parameters) {
  LowPasses filters;
  for (int axis = 0; axis < 3; ++axis) {
    filters[static_cast<std::size_t>(axis)] = LowPass(parameters.bandwidth_hz[axis], parameters.bandwidth_order);
  }
  return filters;
}

/// Stage 5a: the sensor's bandwidth, per axis a LowPass from the rate u that the sensor feels to the rate y whose
/// integral over each interval it puts out.
///
/// Solved exactly, interval by interval, for the mean of u; what u does about its mean within the interval comes as
/// `unsteady`: the answers of the same filter, in continuous time, to the vibration (Vibration::passed) and to the
/// motion (MotionResponse). What is added sample by sample, such as bias and white noise, has nothing but a mean.
/// Nothing is lost: output and input increments differ by what the filter's state holds back. It starts settled on the
/// first interval's mean, and in step with a vibration.
class Bandwidth {
 public:
  Bandwidth(const TriadParameters& parameters, double dt_s) : dt_s_(dt_s) { retune(parameters); }

  bool is_off() const { return is_off_; }

  /// Takes another bandwidth between two intervals; the states go on.
  void retune(const TriadParameters& parameters) {
    is_off_ = parameters.bandwidth_hz.isZero(0.0);
    const LowPasses filters = low_passes(parameters);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Axis& a = axes_[axis];
      a.filter = filters[axis];
      a.decay = std::exp(-a.filter.s() * dt_s_);
      a.missing = -std::expm1(-a.filter.s() * dt_s_);
      a.cosine = std::cos(a.filter.s() * dt_s_);
      a.sine = std::sin(a.filter.s() * dt_s_);
      if (a.filter.order() == 0) a.starts = true;
    }
  }

  /// The next interval begins settled on its own input, as after a relocation of the sensor.
  void restart() {
    for (Axis& axis : axes_) axis.starts = true;
  }

  /// The increment that comes out of the filter, rad | m/s.
  Vector3 filtered(const Vector3& increment, const Unsteady& unsteady = {}) {
    Vector3 out;
    for (int axis = 0; axis < 3; ++axis) {
      Axis& a = axes_[static_cast<std::size_t>(axis)];
      if (a.starts) a.start(increment[axis] / dt_s_ + unsteady.start_y[axis], unsteady.start_slope[axis]);
      out[axis] = a.filtered(increment[axis], dt_s_);
      if (a.filter.order() == 0) continue;
      out[axis] += unsteady.integral[axis];
      a.y += unsteady.y[axis];
      a.slope += unsteady.slope[axis];
    }
    return out;
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    for (auto& axis : self.axes_) visit(axis.starts, axis.y, axis.slope);
  }

 private:
  struct Axis {
    LowPass filter;
    double decay = 1.0;
    double missing = 0.0;  ///< 1 - decay
    double cosine = 1.0;
    double sine = 0.0;
    bool starts = true;
    double y = 0.0;      ///< rad/s | m/s^2
    double slope = 0.0;  ///< y', second order alone

    void start(double y_settled, double slope_settled) {
      if (filter.order() == 0) return;
      y = y_settled;
      slope = slope_settled;
      starts = false;
    }

    double filtered(double increment, double dt_s) {
      if (filter.order() == 0) return increment;
      const double s = filter.s();
      const double u = increment / dt_s;
      const double z = y - u;  // z follows the filter's own equation: it decays
      if (filter.order() == 1) {
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
