#pragma once

#include <algorithm>

#include "inslab/models/imu/triad_parameters.hpp"

namespace inslab::imu {

/// Stage 4a, too: the bias of a triad that comes with how its temperature T changes.
///
///   rate          r T': heat flows through the sensor and bends it. Its integral is r times the change of T.
///   hysteresis    h (T - p) / w, where the play p follows T when it is further off than w/2 (Preisach's operator with
///                 one element: Mayergoyz, "Mathematical Models of Hysteresis", 1991): +h/2 while T has risen long
///                 enough, -h/2 while it has fallen, and between them a straight line over w of a turning T
///
/// The play begins at the temperature at which it is switched on, without a bias.
class ThermalBias {
 public:
  explicit ThermalBias(const TriadParameters& parameters) { take(parameters); }

  bool is_off() const { return is_off_; }

  /// Takes new parameters between two intervals. Keep: the play goes on; otherwise it begins afresh.
  void retune(const TriadParameters& parameters, Continuity continuity) {
    take(parameters);
    if (continuity != Continuity::Keep || hysteresis_.isZero(0.0)) begun_ = false;
  }

  /// The error of an interval of `dt_s` in which the temperature goes from one to the other, rad | m/s. Intervals come
  /// in order: the play follows, and is held over each of them where it ends up.
  Vector3 error(double from_deg_c, double to_deg_c, double dt_s) {
    Vector3 error = rate_ * (to_deg_c - from_deg_c);
    if (hysteresis_.isZero(0.0)) return error;
    if (!begun_) play_deg_c_ = from_deg_c;
    begun_ = true;
    play_deg_c_ = std::clamp(play_deg_c_, to_deg_c - 0.5 * width_k_, to_deg_c + 0.5 * width_k_);
    return error + hysteresis_ * ((to_deg_c - play_deg_c_) / width_k_ * dt_s);
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.begun_, self.play_deg_c_);
  }

 private:
  void take(const TriadParameters& parameters) {
    rate_ = parameters.bias_per_warming;
    hysteresis_ = parameters.bias_hysteresis;
    width_k_ = parameters.bias_hysteresis_width_k;
    is_off_ = rate_.isZero(0.0) && hysteresis_.isZero(0.0);
  }

  Vector3 rate_;        ///< rad/s | m/s^2 per K/s
  Vector3 hysteresis_;  ///< rad/s | m/s^2
  double width_k_;
  bool is_off_;
  bool begun_ = false;
  double play_deg_c_ = 0.0;
};

}  // namespace inslab::imu
