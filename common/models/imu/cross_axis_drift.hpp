#pragma once

#include <array>
#include <string>

#include "inslab/models/imu/cross_axis.hpp"
#include "inslab/models/imu/triad_parameters.hpp"
#include "inslab/noise/random/gauss_markov.hpp"

namespace inslab::imu {

/// Stage 3c, too: the part of the cross-axis angles that drifts, a first-order Gauss-Markov process each, held over
/// each sample. On top of CrossAxis's fixed ones.
class CrossAxisDrift {
 public:
  /// `triad` is the root of the stream names, such as "imu0/gyro". Throws std::invalid_argument as the processes do.
  CrossAxisDrift(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad)
      : angles_{angle(parameters, 0, dt_s, seed, triad + "/cross_axis_gm.x_y"),
                angle(parameters, 1, dt_s, seed, triad + "/cross_axis_gm.x_z"),
                angle(parameters, 2, dt_s, seed, triad + "/cross_axis_gm.y_x"),
                angle(parameters, 3, dt_s, seed, triad + "/cross_axis_gm.y_z"),
                angle(parameters, 4, dt_s, seed, triad + "/cross_axis_gm.z_x"),
                angle(parameters, 5, dt_s, seed, triad + "/cross_axis_gm.z_y")},
        is_off_(parameters.cross_axis_gm_sigma_rad.isZero(0.0)) {}

  bool is_off() const { return is_off_; }

  /// Takes new parameters between intervals `k` - 1 and `k`; continuity as in Bias::retune.
  void retune(const TriadParameters& parameters, Continuity continuity, std::uint64_t k) {
    for (int i = 0; i < 6; ++i) {
      random::GaussMarkov& process = angles_[static_cast<std::size_t>(i)];
      process.retune({parameters.cross_axis_gm_sigma_rad[i], parameters.cross_axis_gm_correlation_time_s[i]});
      if (continuity == Continuity::Reset) process.reset();
      if (continuity == Continuity::Redraw) process.redraw(k);
    }
    is_off_ = parameters.cross_axis_gm_sigma_rad.isZero(0.0);
  }

  /// The error of an input at the interval that is next, in its unit.
  Vector3 next_error(const Vector3& sensed) const {
    Vector6 angles_rad;
    for (int i = 0; i < 6; ++i) angles_rad[i] = angles_[static_cast<std::size_t>(i)].value();
    return CrossAxis(angles_rad).error(sensed);
  }
  /// Interval `k` is over.
  void advance(std::uint64_t k) {
    for (random::GaussMarkov& process : angles_) process.advance(k);
  }

  /// What goes on from sample to sample (data/state/state_stream.hpp); parameters are not part of it.
  template <class Self, class Visitor>
  static void state(Self& self, Visitor& visit) {
    visit(self.angles_);
  }

 private:
  static random::GaussMarkov angle(const TriadParameters& parameters, int i, double dt_s, std::uint64_t seed,
                                   const std::string& stream) {
    return random::GaussMarkov({parameters.cross_axis_gm_sigma_rad[i], parameters.cross_axis_gm_correlation_time_s[i]},
                               dt_s, random::Stream(seed, stream));
  }

  std::array<random::GaussMarkov, 6> angles_;
  bool is_off_;
};

}  // namespace inslab::imu
