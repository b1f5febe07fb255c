#pragma once

#include <complex>
#include <cstdint>
#include <vector>

#include "samples/vibration_profile.hpp"
#include "services/imu_error_injector/increments.hpp"

namespace inslab::imu {

/// Stage 2: vibration added to the IMU's output, thesis (3-33), (3-34): sums of amplitude * sin(2 pi f t + phase) of
/// specific force and angular rate in b, t since the scenario's start.
///
/// Each interval is integrated in closed form, (amplitude / pi f) sin(pi f dt) sin(2 pi f t_middle + phase), so a
/// frequency above half the sample rate comes out as its integral and not as an alias; whole turns are taken off f t
/// exactly, so a phase is as good after a week as at the start.
///
/// A swap may fade: the new profile's weight is (1 - cos(pi tau))/2 (continuous with its slope), the old one's the
/// rest. Products of cosines are sums of cosines, so fades are integrated in closed form, too. At most two fades
/// overlap: a further swap ends the older at once.
class Vibration {
 public:
  explicit Vibration(const VibrationProfile& profile);

  /// From `time_ns` on the vibration is `profile`, after a fade of `fade_s` (0: at once). The weights of what is fading
  /// already go on. Times of calls must not go back.
  void swap(const VibrationProfile& profile, std::int64_t time_ns, double fade_s);

  /// The integrals over (from_ns, to_ns], to_ns > from_ns.
  Increments increments(std::int64_t from_ns, std::int64_t to_ns);

 private:
  struct Tone {
    /// dt sinc(pi f dt), s: the part of an interval's integral that depends on its length alone, which seldom changes.
    double gain_over(std::int64_t interval_ns);

    double frequency_hz;
    Vector3 sine;    ///< amplitude * cos(phase), SI
    Vector3 cosine;  ///< amplitude * sin(phase), SI
    std::int64_t cached_interval_ns = 0;
    double cached_gain_s = 0.0;
  };
  struct Layer {
    std::vector<Tone> linear;
    std::vector<Tone> angular;
  };
  /// Layer i + 1 rises and all layers before it fall with fade i.
  struct Fade {
    std::int64_t start_ns;
    std::int64_t length_ns;
  };
  struct Gate {
    Fade fade;
    bool rising;
  };
  struct Span {
    std::int64_t from_ns;
    std::int64_t to_ns;
  };

  static Layer layer_of(const VibrationProfile& profile);
  static std::complex<double> gated_integral(double frequency_hz, double middle_turns, const Span& span,
                                             const Gate* gate, const Gate* end);
  static Vector3 integral(std::vector<Tone>& tones, const Span& span, const std::vector<Gate>& gates);
  void drop_layers_until(std::size_t count);

  std::vector<Layer> layers_;
  std::vector<Fade> fades_;
};

}  // namespace inslab::imu
