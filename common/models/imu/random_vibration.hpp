#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inslab/models/imu/low_pass.hpp"
#include "inslab/models/imu/spectrum.hpp"
#include "inslab/noise/random/stream.hpp"

namespace inslab::imu {

/// Stationary Gaussian vibration of a triad with a given power spectral density, as its integrals over the intervals.
///
/// The integral over dt of a process of (two-sided) density S has, as a series sampled every dt, the density
///
///   S_d(f) = sum over m of S(f + m/dt) (dt sinc(pi (f + m/dt) dt))^2,   |f| <= 1/(2 dt)
///
/// in which what lies above half the sample rate is folded at the strength the integral leaves of it. A low-pass filter
/// multiplies S by |H|^2 before it is folded. The series is
/// white noise through a filter of zero phase: y[k] = sum over j of h[j] w[k + j], w ~ N(0, 1), where h is the inverse
/// Fourier transform of sqrt(S_d / dt) at n frequencies 1/(n dt) apart, tapered by a Hann window, which rounds corners
/// over one such step to each side. n is the power of 2 that gives the lowest frequency of the table, and the lowest
/// bandwidth, eight steps, within 256 to 1024. Any interval is a pure function of (stream, k); what is kept of the
/// noise is a cache.
class RandomVibration {
 public:
  /// `root` of the stream names, such as "imu0/vibration/accel". `dt_s` > 0; the spectrum is not empty.
  RandomVibration(const Spectrum& spectrum, double dt_s, std::uint64_t seed, const std::string& root,
                  const LowPasses& filters = {});

  /// The integral over interval `k`, rad | m/s. Cheap for intervals that follow each other, and for one asked again.
  Vector3 increment(std::uint64_t k);

  /// One-sided density of the series of increments over dt, that is of mean rates, which the filter realises:
  /// (m/s^2)^2/Hz | (rad/s)^2/Hz, at 0 <= frequency_hz <= 1/(2 dt).
  double realised_density(int axis, double frequency_hz) const;

 private:
  struct Axis {
    std::vector<double> filter;
    random::Stream stream;
    std::vector<double> noise;  ///< numbers first to first + size of the stream
    std::uint64_t first = 0;

    double increment(std::uint64_t k);
  };

  double dt_s_;
  std::vector<Axis> axes_;
  std::optional<std::uint64_t> last_k_;
  Vector3 last_ = Vector3::Zero();  ///< of last_k_
};

}  // namespace inslab::imu
