#pragma once

#include "inslab/models/imu/axes.hpp"
#include "inslab/models/imu/triad_parameters.hpp"
#include "inslab/noise/random/white_noise.hpp"

namespace inslab::imu {

/// Stage 4b: white noise of a triad, its angle or velocity random walk, and the burst that a fault adds to it from
/// streams of its own.
class Noise {
 public:
  /// `triad` is the root of the stream names, such as "imu0/gyro"; `walk` names the noise in them, "arw" or "vrw".
  Noise(const TriadParameters& parameters, double dt_s, std::uint64_t seed, const std::string& triad,
        const std::string& walk)
      : white_(per_axis(triad,
                        [&](int axis, const std::string& root) {
                          return random::WhiteNoise(parameters.random_walk[axis], dt_s,
                                                    random::Stream(seed, root + walk));
                        })),
        burst_(per_axis(triad, [&](int, const std::string& root) {
          return random::WhiteNoise(0.0, dt_s, random::Stream(seed, root + "burst"));
        })) {}

  /// Takes new parameters between two intervals.
  void retune(const TriadParameters& parameters) {
    for (int axis = 0; axis < 3; ++axis) white_[axis].retune(parameters.random_walk[axis]);
  }

  /// Density of the burst, rad/sqrt(s) | m/s/sqrt(s); zero ends it.
  void set_burst(const Vector3& density) {
    for (int axis = 0; axis < 3; ++axis) burst_[axis].retune(density[axis]);
    has_burst_ = !density.isZero(0.0);
  }

  /// The error of interval `k`, rad | m/s. Depends on the streams and k alone.
  Vector3 error(std::uint64_t k) {
    Vector3 sum;
    for (int axis = 0; axis < 3; ++axis) sum[axis] = white_[axis].increment(k);
    if (!has_burst_) return sum;
    for (int axis = 0; axis < 3; ++axis) sum[axis] += burst_[axis].increment(k);
    return sum;
  }

 private:
  std::array<random::WhiteNoise, 3> white_;
  std::array<random::WhiteNoise, 3> burst_;
  bool has_burst_ = false;
};

}  // namespace inslab::imu
