#pragma once

#include "inslab/models/faults/axis_faults.hpp"
#include "inslab/models/imu/bandwidth.hpp"
#include "inslab/models/imu/quantization.hpp"
#include "inslab/models/imu/saturation.hpp"

namespace inslab::imu {

/// What the filters of a triad need to know of an interval beside its increment.
struct WithinInterval {
  Unsteady unsteady;
  Vector3 random_felt = Vector3::Zero();    ///< rad | m/s: the part that random vibration has in the increment
  Vector3 random_passed = Vector3::Zero();  ///< what the filters make of that part
};

/// Stage 5 of one triad: from the increment with every error to what comes out of the sensor.
class TriadLimits {
 public:
  TriadLimits(const TriadParameters& parameters, double dt_s)
      : dt_s_(dt_s), bandwidth_(parameters, dt_s), saturation_(parameters, dt_s), quantization_(parameters) {}

  /// Takes new parameters between two intervals. Keep: filter and remainder go on; otherwise they start afresh.
  void retune(const TriadParameters& parameters, Continuity continuity) {
    bandwidth_.retune(parameters);
    saturation_ = Saturation(parameters, dt_s_);
    quantization_.retune(parameters);
    if (continuity == Continuity::Keep) return;
    bandwidth_.restart();
    quantization_.reset();
  }

  void set_faults(const std::array<AxisFault, 3>& axes, bool silent) {
    faults_.set(axes);
    silent_ = silent;
  }

  /// The sensor is somewhere else from the next interval on.
  void relocate() { bandwidth_.restart(); }

  struct Result {
    Vector3 increment;  ///< rad | m/s
    bool valid = true;
    bool saturated = false;
  };
  /// What comes out of an interval for `increment`, rad | m/s; without it (`dropped`, or a silent sensor) 0 and not
  /// valid. Intervals come in order: filter and remainder go on. Filter and full scale act on the mean rate, so they
  /// see the increment of an interval of mean length; `stretch` is SampleInterval's.
  Result applied(const Vector3& increment, bool dropped, double stretch = 1.0) {
    const Vector3 mean = increment / stretch;
    return cut(bandwidth_.is_off() ? mean : bandwidth_.filtered(mean), dropped, stretch);
  }
  Result applied(const Vector3& increment, bool dropped, double stretch, const WithinInterval& within) {
    if (bandwidth_.is_off()) return applied(increment, dropped, stretch);
    Unsteady unsteady = within.unsteady;
    unsteady.integral /= stretch;
    const Vector3 filtered = bandwidth_.filtered((increment - within.random_felt) / stretch, unsteady);
    return cut(filtered + within.random_passed / stretch, dropped, stretch);
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.bandwidth_, self.quantization_, self.faults_);
  }

 private:
  Result cut(const Vector3& filtered, bool dropped, double stretch) {
    Result out{filtered};
    if (!saturation_.is_off()) {
      const Saturation::Result limited = saturation_.limited(out.increment);
      out.increment = limited.increment;
      out.saturated = limited.saturated;
    }
    out.increment *= stretch;
    if (!quantization_.is_off()) out.increment = quantization_.quantized(out.increment);
    out.increment = faults_.applied(out.increment);
    if (dropped || silent_) return {Vector3::Zero(), false, false};
    return out;
  }

  double dt_s_;
  Bandwidth bandwidth_;
  Saturation saturation_;
  Quantization quantization_;
  faults::AxisFaults faults_;
  bool silent_ = false;
};

}  // namespace inslab::imu
